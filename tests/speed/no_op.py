"""A model that does nothing, so that what a job takes is what the harness takes."""

import numpy as np

from mocapbench.baselines import Imputer, Prediction


class NoOp(Imputer):
    """Answers zeros."""

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(r, np.zeros(r.values.shape)) for r in recordings]


MODELS = {"no-op": NoOp}
