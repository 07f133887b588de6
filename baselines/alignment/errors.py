"""What the visible channels of a frame tell of its hidden ones, beyond style and state.

In the model, the noise of a frame is independent between channels. In recordings it is not: a leg
that swings further than its cycle goes with an arm that does. The covariance of the errors of
visible entries corrects the hidden ones, frame by frame, by Gaussian regression.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.covariance import ledoit_wolf

from mocapbench.baselines.alignment.sequences import Array, Sequences

__all__ = ["corrected", "error_correlation"]

_OWN = 1e-3  # least variance of a channel's own error, so that channels without errors do no harm


def error_correlation(errors: Array) -> Array:
    """Return the correlations of errors (N, F) between channels, shrunk after Ledoit and Wolf.

    An entry that is hidden has error 0, which pulls correlations towards zero.
    """
    shrunk = ledoit_wolf(errors, assume_centered=True)[0]
    return np.asarray(shrunk + _OWN * np.eye(len(shrunk)))


def corrected(mean: Array, sequences: Sequences) -> Array:
    """Return the means (N, F) of the last sequence, corrected by the visible errors of its frames.

    Variances are left as they are: errors of style and state are not Gaussian, and variances that
    shrink with the correction would claim too much.

    Parameters
    ----------
    mean : ndarray of shape (K, N, F)
        The mean of every entry by style and state alone.
    sequences : Sequences
        The K sequences.
    """
    errors = (sequences.values - mean) * sequences.visible
    seen = errors[sequences.frames]
    unit = np.sqrt((seen**2).mean(axis=0)) + np.finfo(float).tiny
    correlation = error_correlation(seen / unit)
    n_frames = sequences.lengths[-1]
    filled = mean[-1, :n_frames].copy()
    last, visible = errors[-1, :n_frames] / unit, sequences.visible[-1, :n_frames] > 0
    for frames, known in _patterns(visible):
        gain = np.linalg.solve(
            correlation[np.ix_(known, known)], correlation[np.ix_(known, ~known)]
        )
        filled[np.ix_(frames, ~known)] += last[np.ix_(frames, known)] @ gain * unit[~known]
    return filled


def _patterns(visible: NDArray[np.bool_]) -> list[tuple[NDArray[np.intp], NDArray[np.bool_]]]:
    """Return frames that show the same channels, with those channels, if some but not all."""
    shown, which = np.unique(visible, axis=0, return_inverse=True)
    return [
        (np.flatnonzero(which.ravel() == index), known)
        for index, known in enumerate(shown)
        if known.any() and not known.all()
    ]
