"""Whether what a metric returned is a score: one real number, with its parts as arrays."""

from __future__ import annotations

from numbers import Real

import numpy as np

from mocapbench.metrics import Score

__all__ = ["fault_of_score"]


def fault_of_score(score: object) -> str:
    """Return what was expected of a metric and what it returned; nothing if it is a score.

    Parameters
    ----------
    score : object
        What the metric returned.
    """
    if not isinstance(score, Score):
        return f"to return a Score, got {type(score).__name__}; write return Score(value)"
    value, parts = score.value, score.parts
    if not _is_one_number(value):
        return (
            f"to return a Score of one real number, got {_in_words(value)}; write for example "
            "Score(float(errors.mean()))"
        )
    wrong = [axis for axis, values in parts.items() if not isinstance(values, np.ndarray)]
    if wrong:
        got = f"{_in_words(parts[wrong[0]])} for {wrong[0]!r}"
        return f"to give the parts of its Score as arrays, got {got}; write numpy.asarray(…)"
    return ""


def _is_one_number(value: object) -> bool:
    """Return whether ``value`` is a real number, also as an array without axes."""
    if isinstance(value, np.ndarray):
        return value.ndim == 0 and value.dtype.kind in "biuf"
    return isinstance(value, Real | np.bool_)


def _in_words(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} of shape {value.shape}"
    return f"{value!r:.80}"
