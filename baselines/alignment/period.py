"""The length of a cycle, from the data alone."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.alignment.sequences import Array, Sequences

__all__ = ["autocorrelation", "cycle_length", "default_states"]

_FEWEST_REPEATS = 2  # a lag is believed where a sequence is at least this many times as long
_AS_GOOD = 0.9  # two cycles resemble themselves as one does, but for the noise of the estimate


def autocorrelation(sequences: Sequences) -> Array:
    """Return the autocorrelation of each sequence at lags 0 to N − 1: (K, N).

    Pooled over channels, each mean taken over the pairs of entries that are both visible; NaN at a
    lag without any.
    """
    visible = sequences.visible
    n_frames = visible.shape[1]
    seen = np.maximum(sequences.counts, 1.0)
    mean = sequences.values.sum(axis=1) / seen
    centred = (sequences.values - mean[:, None]) * visible
    products, pairs = (_lagged_products(array)[:, :n_frames] for array in (centred, visible))
    pairs = np.round(pairs)
    covariance = np.divide(products, pairs, out=np.full_like(pairs, np.nan), where=pairs > 0)
    variance = np.where(covariance[:, :1] > 0, covariance[:, :1], np.nan)
    return np.asarray(covariance / variance)


def cycle_length(sequences: Sequences) -> int:
    """Return the expected number of frames of a cycle, N of HLM.

    The median over sequences of the lag at which a sequence first resembles itself again: the
    first peak of the autocorrelation, after it has been negative and within half the sequence,
    that is nine tenths as high as the highest. If no sequence is long enough to have one, the
    median length: each is then taken for one cycle.
    """
    lags = [
        _first_return(correlation[: length // _FEWEST_REPEATS + 1])
        for correlation, length in zip(autocorrelation(sequences), sequences.lengths, strict=True)
    ]
    found = [lag for lag in lags if lag]
    return int(np.median(found if found else sequences.lengths))


def default_states(sequences: Sequences, max_jump: int) -> int:
    """Return M = 2N of HLM §2; as many as the jumps need where cycles are very short."""
    return max(2 * cycle_length(sequences), 2 * max_jump + 1)


def _lagged_products(array: Array) -> Array:
    """Return Σ_f Σ_i a_i a_{i+lag} for each lag, by the Fourier transform."""
    size = 2 * array.shape[1]
    power = np.abs(np.fft.rfft(array, size, axis=1)) ** 2
    return np.fft.irfft(power.sum(axis=2), size, axis=1)


def _first_return(correlation: Array) -> int:
    """Return the lag of the first high peak after the first negative value; 0 if none."""
    negative = np.flatnonzero(correlation < 0)
    if not len(negative):
        return 0
    inner = correlation[1:-1]
    peak = (inner > correlation[:-2]) & (inner >= correlation[2:])
    peaks = np.flatnonzero(peak) + 1
    peaks = peaks[(peaks > negative[0]) & (correlation[peaks] > 0)]
    heights = correlation[peaks]
    return int(peaks[np.argmax(heights >= _AS_GOOD * heights.max())]) if len(peaks) else 0
