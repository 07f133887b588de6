"""Models that fill without learning, and claim variances that may be too small or too large."""

import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.baselines.rehearsal.checkable import Widened

__all__ = ["Claiming", "Drifting"]


class Claiming(Widened):
    """Predicts 0 and claims one variance."""

    def __init__(self, variance=1.0):
        self.variance = variance

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return self.as_claimed(recordings)

    def as_claimed(self, recordings):
        return [Prediction.around(recording, 0.0, self.variance) for recording in recordings]


class Drifting(Widened):
    """Predicts the last visible value, and claims a power of the time since."""

    def __init__(self, power=0.0):
        self.power = power

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return self.as_claimed(recordings)

    def as_claimed(self, recordings):
        return [self.held(recording) for recording in recordings]

    def held(self, recording):
        frames = np.arange(len(recording.times))[:, None]
        last = np.maximum.accumulate(np.where(recording.visible, frames, 0))
        mean = np.take_along_axis(recording.values, last, axis=0)
        return Prediction.around(recording, mean, np.maximum(frames - last, 1.0) ** self.power)
