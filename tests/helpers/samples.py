"""Small samples and recordings for tests."""

import numpy as np

from mocapbench.datasets import Recording
from mocapbench.reports.analysis.units import FoldSample

__all__ = ["draws", "gap", "recording", "walks_of_two_styles"]


def draws(values):
    """Return the sample of values that are independent draws of one case, such as of toy data."""
    units = [f"fold {number} of row" for number in range(len(values))]
    return FoldSample.of([*map(float, values)], units, ["row"] * len(values))


def recording(name, values):
    """Return a recording of ``values`` (N, D), 30 frames a second, whose channels have no unit."""
    values = np.asarray(values, dtype=float)
    channels = tuple(f"c{d}" for d in range(values.shape[1]))
    return Recording(name, np.arange(len(values)) / 30, values, channels, ("",) * len(channels))


def gap(truth, first, last, channels=slice(None)):
    """Return a recording with the channels hidden in the frames [first, last)."""
    hidden = np.zeros(truth.values.shape, dtype=bool)
    hidden[first:last, channels] = True
    return truth.hide(hidden)


def walks_of_two_styles():
    """Return six walks whose styles, which alternate, differ in the offset of a channel."""
    return tuple(_walks())


def _walks():
    rng = np.random.default_rng(0)
    for k in range(6):
        phase = 2.0 * np.pi * (np.arange(40) / 12.0 + rng.random())
        values = 5.0 * np.sin(phase[:, None] * [1, 2] + [0.0, 1.0]) + [0.0, 6.0 * (k % 2)]
        values += 0.2 * rng.normal(size=values.shape)
        yield Recording(f"w{k}", np.arange(40) / 30, values, ("a", "b"), ("deg", "deg"))
