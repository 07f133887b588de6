"""A simple sampler, and one that scores better because it hardly varies."""

import numpy as np

from mocapbench.baselines import Synthesiser


class Resampler(Synthesiser):
    """Draws the children's mean and a random mixture of their deviations from it."""

    def fit(self, recordings):
        values = np.stack([recording.values for recording in recordings])
        self.mean_ = values.mean(axis=0)
        self.deviations_ = (values - self.mean_) / np.sqrt(len(values) - 1)
        return self

    def sample(self, times, n_samples, random_state):
        rng = np.random.default_rng(random_state)
        weights = rng.standard_normal((n_samples, len(self.deviations_)))
        return self.mean_ + np.tensordot(weights, self.deviations_, axes=1)


class Collapsed(Resampler):
    """Draws a hundredth of that variance."""

    def sample(self, times, n_samples, random_state):
        samples = super().sample(times, n_samples, random_state)
        return self.mean_ + 0.1 * (samples - self.mean_)


MODELS = {"resampler": Resampler, "collapsed": Collapsed}
