"""Models that misbehave, each in its own way, for the tests of the harness."""

import os
import time

import numpy as np

from mocapbench.baselines import Imputer, Prediction


class _Mean(Imputer):
    """Fills every hidden entry with the mean of all visible ones."""

    def fit(self, recordings):
        values = np.concatenate([recording.values.ravel() for recording in recordings])
        self.mean_ = float(np.nanmean(values))
        return self

    def impute(self, recordings):
        return [Prediction.around(r, np.full(r.values.shape, self.mean_)) for r in recordings]


class Raises(_Mean):
    def fit(self, recordings):
        raise RuntimeError("the model <b>raised</b>")


class Singular(_Mean):
    def fit(self, recordings):
        np.linalg.cholesky(np.zeros((2, 2)) - np.eye(2))


class NotANumber(_Mean):
    def impute(self, recordings):
        return [Prediction(np.full(r.values.shape, np.nan)) for r in recordings]


class WrongShape(_Mean):
    def impute(self, recordings):
        return [Prediction(np.zeros((2, 2))) for _ in recordings]


class WrongCount(_Mean):
    def impute(self, recordings):
        return []


class NoVariance(_Mean):
    def impute(self, recordings):
        return [Prediction(np.zeros(r.values.shape), np.zeros(r.values.shape)) for r in recordings]


class Hangs(_Mean):
    def fit(self, recordings):
        time.sleep(600)


class Exits(_Mean):
    def fit(self, recordings):
        raise SystemExit(5)


class Interrupts(_Mean):
    def fit(self, recordings):
        raise KeyboardInterrupt


class Arrays(_Mean):
    def impute(self, recordings):
        return [recording.values for recording in recordings]


class Unlocks(_Mean):
    def impute(self, recordings):
        recordings[0].values.setflags(write=True)


class Counts(_Mean):
    """Well-behaved, with counts that NumPy made."""

    def fit(self, recordings):
        self.n_iterations_, self.converged_ = np.int64(3), np.bool_(True)
        return super().fit(recordings)


class Dies(_Mean):
    def fit(self, recordings):
        os._exit(7)


class Hungry(_Mean):
    def fit(self, recordings):
        self.hoard_ = np.ones(2**40)


MODELS = {
    "raises": Raises,
    "singular": Singular,
    "not-a-number": NotANumber,
    "wrong-shape": WrongShape,
    "wrong-count": WrongCount,
    "no-variance": NoVariance,
    "hangs": Hangs,
    "exits": Exits,
    "interrupts": Interrupts,
    "arrays": Arrays,
    "unlocks": Unlocks,
    "counts": Counts,
    "dies": Dies,
    "hungry": Hungry,
    "well-behaved": _Mean,
}
