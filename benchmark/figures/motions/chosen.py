"""Which entrants a player shows."""

from __future__ import annotations

from typing import Any

from mocapbench.basics.words import format_count
from mocapbench.benchmark.figures.solved import Solved

__all__ = ["Chosen", "choose_entrants"]


Chosen = tuple[tuple[str, ...], str, str]
"""The labels of entrants, best first; the one to show beside the first; and which they are."""


def choose_entrants(solved: Solved[Any, Any], n_most: int) -> Chosen:
    """Return the best entrants by the task's first metric, and the best interpolation.

    Returns
    -------
    labels : tuple of str
        Best first.
    beside : str
        The one to show beside the first: the best interpolation, else the second.
    phrase : str
        Which they are, for a caption.
    """
    ranked = [label for label in solved.ranking if label in solved.answers]
    ranked += [label for label in solved.answers if label not in ranked]
    best, others = ranked[:n_most], ranked[n_most:]
    first = [label for label in ranked if label in solved.interpolations][:1]
    labels = (*best, *(label for label in others if label in first))
    beside = next((label for label in (*first, *labels[1:2]) if label != labels[0]), labels[0])
    order = f"best first by {solved.metric} here" if solved.ranking else "in the order of the task"
    if not others:
        return labels, beside, f"All {format_count(len(labels), 'entrant')}, {order}"
    added = " and the best interpolation" if len(labels) > n_most else ""
    return labels, beside, f"The first {n_most} of {len(ranked)} entrants{added}, {order}"
