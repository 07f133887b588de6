"""Correlations between sampled and reference recordings, output by output.

Every sample is compared with every reference, which gives (S, M, D) correlations; the metrics of
`mocapbench.metrics.similarity` are means of these. Thesis stands for J. D. Gil López, *Hierarchical
Multiple Output Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de
Pereira, 2017.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft

from mocapbench.basics.arrays import Array
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = [
    "SampleByReferenceByOutput",
    "cross_correlation",
    "linear_correlation",
]

SampleByReferenceByOutput = NDArray[np.float64]
"""(S, M, D) similarities; NaN in every entry of an output that is left out."""

_ROUNDING = 1e-12
"""Range of an output, relative to its largest value, up to which it counts as constant."""


def cross_correlation(outcome: Synthesis) -> SampleByReferenceByOutput:
    """Return max over all lags n of Σ_m y_ref[m] y_s[m + n], of sequences scaled to [0, 1].

    Each output of each sequence is scaled by its own minimum and maximum. The sum runs over the
    frames where both sequences exist, so it grows with N: compare at equal N. An output that is
    constant in any sample or reference is NaN.

    References
    ----------
    Thesis §4.3, mean cross correlation.
    """
    length = next_fast_len(2 * outcome.samples.shape[1] - 1, real=True)
    samples = rfft(_unit_range(outcome.samples), length, axis=1)
    references = rfft(_unit_range(outcome.references), length, axis=1)
    maxima = [
        irfft(samples * reference.conj(), length, axis=1).max(axis=1) for reference in references
    ]
    return np.where(_constant(outcome), np.nan, np.stack(maxima, axis=1))


def linear_correlation(outcome: Synthesis) -> SampleByReferenceByOutput:
    """Return Pearson's correlation over the frames, at lag 0.

    An output that is constant in any sample or reference is NaN.

    References
    ----------
    Thesis §4.3, mean linear correlation.
    """
    samples, references = _unit_norm(outcome.samples), _unit_norm(outcome.references)
    correlations = np.einsum("snd,mnd->smd", samples, references)
    return np.where(_constant(outcome), np.nan, correlations)


def _constant(outcome: Synthesis) -> NDArray[np.bool_]:
    """(D,) True where an output is constant, but for rounding, in any sample or reference."""
    sequences = np.concatenate([outcome.samples, outcome.references])
    rounding = _ROUNDING * np.abs(sequences).max(axis=1)
    return np.asarray((np.ptp(sequences, axis=1) <= rounding).any(axis=0))


def _unit_range(sequences: Array) -> Array:
    span = np.ptp(sequences, axis=1, keepdims=True)
    shifted = sequences - sequences.min(axis=1, keepdims=True)
    return np.asarray(shifted / np.where(span > 0, span, 1.0))


def _unit_norm(sequences: Array) -> Array:
    centred = sequences - sequences.mean(axis=1, keepdims=True)
    norm = np.linalg.norm(centred, axis=1, keepdims=True)
    return np.asarray(centred / np.where(norm > 0, norm, 1.0))
