"""Errors of predictions in held-out gaps, in the unit of each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import chain

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.choosing.hold_outs import HeldOutGap, HoldOut
from mocapbench.benchmark.filling.gap_problem import PredictedEntries

__all__ = ["list_gaps", "score_gaps", "weigh_gaps"]

_LEAST = 1e-9
"""Errors, relative to the largest value of a gap, below which models differ by rounding only."""


def list_gaps(hold_outs: Iterable[HoldOut]) -> list[HeldOutGap]:
    """Return all held-out gaps, in order."""
    return list(chain.from_iterable(hold_out.gaps for hold_out in hold_outs))


def score_gaps(hold_outs: Sequence[HoldOut], predictions: Sequence[PredictedEntries]) -> Array:
    """Return the root mean squared error of a model in each gap (n,) of the first hold-outs."""
    errors = []
    for hold_out, prediction in zip(hold_outs, predictions, strict=False):
        squares, sizes = (prediction.mean - hold_out.truth) ** 2, np.abs(hold_out.truth)
        for gap in hold_out.gaps:
            least = _LEAST * sizes[gap.entries].max()
            errors.append(max(np.sqrt(squares[gap.entries].mean()), least))
    return np.array(errors)


def weigh_gaps(gaps: Sequence[HeldOutGap]) -> Array:
    """Return the weight of each held-out gap (n,), 1 in the mean.

    A real gap counts by its entries, as it does in the file; its copies share its weight.
    """
    copies = Counter(gap.original for gap in gaps)
    sizes = (len(gap.original) * len(gap.original.channels) for gap in gaps)
    weights = np.array([n / copies[gap.original] for n, gap in zip(sizes, gaps, strict=True)])
    return np.asarray(weights / weights.mean())
