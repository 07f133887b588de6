"""The length of a cycle: that at which a folded recording has the highest signal-to-noise ratio.

After D. Ormoneit, M. J. Black, T. Hastie and H. Kjellström (2005), Representing cyclic human motion
using functional analysis, Image and Vision Computing 23.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize_scalar

from mocapbench.baselines.functional.fourier_series import fourier, roughness
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["complete_blocks", "cycle_periods", "elapsed_times", "frame_step", "signal_to_noise"]

_HARMONICS = 3  # enough for the cycle as a whole; more would fit two cycles as well as one
_PENALTY = 1e-3
_LEAST_FRAMES = 2 * (2 * _HARMONICS + 1)  # visible frames of a channel, two for each coefficient
_FEWEST_FRAMES = 8  # of a cycle: three harmonics have seven coefficients
_GRID = 6  # candidates for each cycle more or less in a recording
_BATCH = 64  # candidates at once, which bounds the memory
# Two cycles fold as well as one. The shortest length this close to the best is the cycle.
_AS_GOOD = 0.5
_CYCLIC = 1.0  # a recording with more noise than signal at every length shows no cycle


def frame_step(recording: Recording) -> float:
    """Return the median time between frames, in seconds; 1 for a single frame."""
    steps = np.diff(recording.times)
    return float(np.median(steps)) if len(steps) else 1.0


def elapsed_times(recording: Recording) -> Array:
    """Return the time of each frame since the first, in seconds: (N,)."""
    return np.asarray(recording.times - recording.times[0])


def complete_blocks(recording: Recording) -> list[tuple[Array, Array]]:
    """Return times (n,) and values (n, d) of the channels that are visible in the same frames.

    Channels of too few visible frames to tell a cycle from noise are left out.
    """
    patterns, owner = np.unique(recording.visible, axis=1, return_inverse=True)
    times = elapsed_times(recording)
    return [
        (times[pattern], recording.values[np.ix_(pattern, owner.ravel() == index)])
        for index, pattern in enumerate(patterns.T)
        if pattern.sum() >= _LEAST_FRAMES
    ]


def signal_to_noise(blocks: Sequence[tuple[Array, Array]], frequencies: Array) -> Array:
    """Return the signal-to-noise ratio of a recording folded at each of ``frequencies`` (n,).

    A smooth periodic function is fitted to each folded channel. The signal is its variance, and the
    noise the mean squared residual by generalised cross-validation, RSS / n / (1 − df / n)², each
    summed over channels; 0 where there is no noise to measure.

    Parameters
    ----------
    blocks : sequence of pairs of ndarray
        As of `complete_blocks`, at least one, of channels in comparable units.
    frequencies : ndarray of shape (n,)
        Cycles per second.

    Returns
    -------
    ndarray of shape (n,)
    """
    batches = np.array_split(frequencies, max(1, -(-len(frequencies) // _BATCH)))
    return np.concatenate([_ratios(blocks, batch) for batch in batches])


def cycle_periods(recordings: Sequence[Recording]) -> Array:
    """Return the length of a cycle in seconds, for each recording: (K,).

    A recording without a length at which it repeats itself takes the median of those of the others.
    If none has one, each recording counts as one cycle.
    """
    found = np.array([_period(recording) for recording in recordings])
    if np.isnan(found).all():
        return np.array([_duration(recording) for recording in recordings])
    return np.where(np.isnan(found), np.nanmedian(found), found)


def _duration(recording: Recording) -> float:
    """Return the time in seconds from the first frame to one frame after the last."""
    return float(elapsed_times(recording)[-1]) + frame_step(recording)


def _period(recording: Recording) -> float:
    """Return the shortest length with a peak as high as the highest, or nearly; NaN if none."""
    blocks = complete_blocks(recording)
    if not blocks:
        return np.nan
    longest = _duration(recording)
    shortest = _FEWEST_FRAMES * frame_step(recording)
    # A peak is as wide as one cycle more or less in the recording.
    grid = np.arange(1.0 / longest, 1.0 / shortest, 1.0 / (_GRID * longest))
    ratios = signal_to_noise(blocks, grid)
    inner = ratios[1:-1]
    peaks = np.flatnonzero((inner > ratios[:-2]) & (inner >= ratios[2:]) & (inner > _CYCLIC)) + 1
    if not len(peaks):
        return np.nan
    # Frequencies rise, so that the last high peak has the shortest length.
    peak = peaks[ratios[peaks] >= _AS_GOOD * ratios[peaks].max()][-1]
    best = minimize_scalar(
        lambda frequency: -signal_to_noise(blocks, np.array([frequency]))[0],
        bounds=(grid[peak - 1], grid[peak + 1]),
        method="bounded",
        options={"xatol": 1e-3 * grid[0]},
    )
    return float(1.0 / best.x)


def _ratios(blocks: Sequence[tuple[Array, Array]], frequencies: Array) -> Array:
    fits = [
        _fit(fourier(np.outer(frequencies, times), _HARMONICS), values) for times, values in blocks
    ]
    signal, squares, freedom = np.sum(fits, axis=0)
    total = sum(values.size for _, values in blocks)
    # Generalised cross-validation: RSS / n / (1 − df / n)².
    noise = squares / total / (1.0 - freedom / total) ** 2
    ratios = np.divide(signal / total, noise, out=np.zeros_like(noise), where=noise > 0)
    return np.asarray(ratios)


def _fit(basis: Array, values: Array) -> tuple[Array, Array, Array]:
    """Return sums of squares of signal and residuals, and degrees of freedom, by frequency."""
    transposed = basis.swapaxes(1, 2)
    gram = transposed @ basis
    # One solve for (G + P)⁻¹ G, whose trace is the degrees of freedom, and the coefficients.
    right = np.concatenate([gram, transposed @ values], axis=2)
    solved = np.linalg.solve(gram + _PENALTY * np.diag(roughness(_HARMONICS)), right)
    hat, coefficients = np.split(solved, [gram.shape[2]], axis=2)
    fit = basis @ coefficients
    signal = ((fit - fit.mean(axis=1, keepdims=True)) ** 2).sum(axis=(1, 2))
    squares = ((values - fit) ** 2).sum(axis=(1, 2))
    return signal, squares, values.shape[1] * np.trace(hat, axis1=1, axis2=2)
