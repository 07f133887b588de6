"""The choice among models by held-out gaps, without knowing what is hidden.

* `jointly`: Gaussian processes over a recording and those that were learnt from;
* `candidates`: the models to choose from, fitted to the same recordings;
* `parts`: entries that are weighed together;
* `held_out_errors`: their errors where the truth is known, in the recording itself and others;
* `weights`: from these errors to the weights of models.
"""
