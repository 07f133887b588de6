"""Random recordings of cyclic motion, and random curves."""

import numpy as np
import pytest

from mocapbench.baselines.functional.fourier_series import CurveStatistics
from mocapbench.datasets import Recording


class Waves:
    """Recordings of two channels that repeat themselves, with noise and hidden entries."""

    def __init__(self, periods, *, n_frames=90, noise=0.1, hidden=0.0, seed=0):
        rng = np.random.default_rng(seed)
        self.phases, self.recordings = [], []
        for k, period in enumerate(periods):
            phases = rng.random() + np.arange(n_frames) / period
            angles = 2.0 * np.pi * phases[:, None]
            values = np.hstack([np.sin(angles), np.cos(angles) + 0.5 * np.sin(2 * angles)])
            values += noise * rng.normal(size=values.shape)
            values[rng.random(values.shape) < hidden] = np.nan
            self.phases.append(phases)
            self.recordings.append(
                Recording(f"w{k}", np.arange(n_frames) / 30.0, values, ("a", "b"), ("deg", "deg"))
            )


class Curves:
    """Random curves, with random entries hidden: phases, values and statistics."""

    def __init__(self, seed, *, n_curves=5, n_channels=3, n_harmonics=2, hidden=0.3):
        rng = np.random.default_rng(seed)
        self.n_harmonics = n_harmonics
        self.pairs = []
        for n_frames in rng.integers(1, 15, n_curves):
            values = rng.normal(size=(n_frames, n_channels)).cumsum(axis=0)
            values[rng.random(values.shape) < hidden] = np.nan
            self.pairs.append((np.sort(rng.random(n_frames)), values))
        self.pairs[0][1][0] = 1.0  # every channel is visible somewhere
        self.statistics = CurveStatistics.of(self.pairs, n_harmonics)


@pytest.fixture(scope="session")
def waves():
    """Return recordings for their periods in frames."""
    return Waves


@pytest.fixture(scope="session")
def curves():
    """Return curves for a seed and sizes."""
    return Curves
