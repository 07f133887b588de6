"""Models that fill without learning, with variances that may be too small or too large."""

import numpy as np

from mocapbench.baselines import FrameImputer, Prediction

__all__ = ["Drifting", "FixedVariance", "KeepsRecordings"]


class FixedVariance(FrameImputer):
    """Predicts 0 with one variance."""

    def __init__(self, variance=1.0):
        self.variance = variance

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(recording, 0.0, self.variance) for recording in recordings]


class KeepsRecordings(FixedVariance):
    """Says that it learns nothing in `fit`."""

    learns_in_fit = False


class Drifting(FrameImputer):
    """Predicts the last visible value, with a power of the time since as its variance."""

    def __init__(self, power=0.0):
        self.power = power

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [self.hold_last(recording) for recording in recordings]

    def hold_last(self, recording):
        frames = np.arange(len(recording.times))[:, None]
        last = np.maximum.accumulate(np.where(recording.visible, frames, 0))
        mean = np.take_along_axis(recording.values, last, axis=0)
        return Prediction.around(recording, mean, np.maximum(frames - last, 1.0) ** self.power)
