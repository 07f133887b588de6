"""The choice among models by rehearsals, without knowing what is hidden.

* `jointly`: Gaussian processes over a recording and those that were learnt from;
* `candidates`: the models to choose from, fitted to the same recordings;
* `parts`: entries that are weighed together;
* `rehearsals`: gaps where the truth is visible, in the recording itself and in training;
* `weights`: from errors in rehearsals to the weights of models.
"""
