"""The choice among models by rehearsals, without knowing what is hidden.

* `panel`: the models to choose from, fitted to the same recordings;
* `rehearsals`: gaps where the truth is visible, in the recording itself and in training;
* `weights`: from errors in rehearsals to the weights of models.
"""
