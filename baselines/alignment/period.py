"""The length of a cycle, estimated by autocorrelation.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["autocorrelation", "cycle_length", "default_states"]

_FEWEST_REPEATS = 2  # a sequence is at least this many times as long as a lag that is considered
# A lag of two cycles correlates as highly as one of a single cycle, up to noise: of all peaks this
# close to the highest, the first is the cycle.
_AS_GOOD = 0.9


def autocorrelation(sequences: Sequences) -> Array:
    """Return the autocorrelation of each sequence at lags 0 to N − 1: (K, N).

    It is pooled over channels and averaged over the pairs of entries that are both visible; NaN at
    a lag without such pairs.
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

    It is the median over sequences of the first lag at which a sequence recurs: the first peak of
    the autocorrelation after its first negative value, within half the sequence, that is at least
    0.9 times as high as the highest such peak. If no sequence has one, each sequence counts as one
    cycle, and the median length is returned.
    """
    lags = [
        _first_return(correlation[: length // _FEWEST_REPEATS + 1])
        for correlation, length in zip(autocorrelation(sequences), sequences.lengths, strict=True)
    ]
    periods = [lag for lag in lags if lag]
    return int(np.median(periods if periods else sequences.lengths))


def default_states(sequences: Sequences, max_jump: int) -> int:
    """Return M = 2N as in HLM §2, but at least ``2 * max_jump + 1``."""
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
