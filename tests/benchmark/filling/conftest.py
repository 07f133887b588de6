import numpy as np
import pytest

from mocapbench.datasets import Recording

CHANNELS = ("hip.rx", "hip.ry", "knee.rx", "root.ty")
UNITS = ("deg", "deg", "deg", "cm")


@pytest.fixture
def waves():
    """Return a function from a number of frames to a recording of four smooth channels."""

    def make(n_frames=200, name="waves"):
        times = np.arange(n_frames) / 50
        phases = np.arange(4) * 0.7
        values = 20 * np.sin(2 * np.pi * times[:, None] * [1.0, 1.0, 2.0, 0.5] + phases)
        return Recording(name, times, values, CHANNELS, UNITS)

    return make


@pytest.fixture
def hidden():
    """Return a function from blocks (first, stop, channels) to a mask of 200 frames."""

    def make(*blocks, n_frames=200):
        mask = np.zeros((n_frames, 4), dtype=bool)
        for first, stop, channels in blocks:
            mask[first:stop, channels] = True
        return mask

    return make
