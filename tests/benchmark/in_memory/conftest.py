import numpy as np
import pytest

from mocapbench.datasets import Recording

NAMES = ("LKNE", "LANK", "RKNE", "RANK")
CHANNELS = tuple(f"{name}.{axis}" for name in NAMES for axis in "xyz")


@pytest.fixture
def walk():
    """Return a function from a number of frames to a recording of four markers without gaps."""

    def make(n_frames=240, name="walk", seed=0):
        rng = np.random.default_rng(seed)
        times = np.arange(n_frames) / 60
        phases = rng.uniform(0, 2 * np.pi, len(CHANNELS))
        values = 100 * np.sin(2 * np.pi * times[:, None] + phases) + 1000 * rng.normal(
            size=len(CHANNELS)
        )
        values += rng.normal(scale=0.5, size=values.shape)
        return Recording(name, times, values, CHANNELS, ("mm",) * len(CHANNELS))

    return make


@pytest.fixture
def gappy(walk):
    """Return a recording of four markers, two of which have a gap."""
    recording = walk()
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[50:60, :3] = True
    hidden[120:170, 6:9] = True
    return recording.hide(hidden)
