"""How much longer `mocapbench.fill(walk, model="linear")` takes in memory than SciPy's own call.

    python docs/evidence/in_memory.py [FRAMES] [MARKERS]

Both fill the same array of 600 frames and 40 markers with ten gaps, unless other numbers are given,
in turn, and the median of the differences counts: other work on the machine disturbs both alike.
Prints milliseconds.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

import mocapbench

N_PAIRS = 50
N_GAPS, LENGTH = 10, 24
RATE = 120.0


def make_walk(n_frames: int, n_markers: int) -> NDArray[np.float64]:
    """Return coordinates (N, D) of a generated course, NaN in the gaps."""
    rng = np.random.default_rng(0)
    values = np.cumsum(rng.normal(size=(n_frames, 3 * n_markers)), axis=0)
    starts = np.linspace(LENGTH, n_frames - 2 * LENGTH, N_GAPS).astype(int)
    for start, marker in zip(starts, rng.integers(n_markers, size=N_GAPS), strict=True):
        values[start : start + LENGTH, 3 * marker : 3 * marker + 3] = np.nan
    return values


def interpolate(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the array with each gap of each channel filled by a line, as SciPy draws it."""
    filled, frames = values.copy(), np.arange(len(values))
    for channel in np.flatnonzero(np.isnan(values).any(axis=0)):
        hidden = np.isnan(values[:, channel])
        line = make_interp_spline(frames[~hidden], values[~hidden, channel], k=1)
        filled[hidden, channel] = line(frames[hidden])
    return filled


def measure(call: Callable[[], object]) -> float:
    """Return the milliseconds of a call."""
    start = time.perf_counter()
    call()
    return 1000.0 * (time.perf_counter() - start)


def main(n_frames: int, n_markers: int) -> None:
    """Print the medians of both, and that of the differences of pairs."""
    values = make_walk(n_frames, n_markers)
    names = [f"M{number}.{axis}" for number in range(n_markers) for axis in "xyz"]
    ways = (
        lambda: mocapbench.fill(values, "linear", rate=RATE, names=names, units="mm"),
        lambda: interpolate(values),
    )
    np.testing.assert_allclose(ways[0]().recording.values, ways[1](), rtol=1e-10)
    pairs = np.array([[measure(way) for way in ways] for _ in range(N_PAIRS)])
    ours, theirs = np.median(pairs, axis=0)
    more = np.median(pairs[:, 0] - pairs[:, 1])
    print(f"mocapbench {ours:.1f} ms, SciPy {theirs:.1f} ms, difference {more:.1f} ms")


if __name__ == "__main__":
    main(*map(int, [*sys.argv[1:], "600", "40"][:2]))
