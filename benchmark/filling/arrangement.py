"""One arrangement of a problem, in whatever order and by whatever names its recordings come.

Sums of numbers differ in their last digits by the order of their terms, and models draw at random
by the order of channels. So models are given channels by name, training recordings by what they
contain, and no names of files.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.recordings import by_content
from mocapbench.basics.arrays import Index
from mocapbench.benchmark.filling.gap_problem import GapProblem

__all__ = ["arrange", "arrange_entries", "restore_entries"]


def arrange(problem: GapProblem) -> tuple[GapProblem, Index]:
    """Return the problem, arranged, and which of its channels (D,) each one was."""
    channels = problem.given.channels
    order = np.array(sorted(range(len(channels)), key=channels.__getitem__))
    names = [channels[channel] for channel in order]
    train = by_content([recording.select(names) for recording in problem.train])
    arranged = GapProblem(
        replace(problem.given.select(names), name="the recording"),
        problem.target[:, order],
        tuple(replace(one, name=f"training {n}") for n, one in enumerate(train, start=1)),
    )
    return arranged, order


def arrange_entries(entries: NDArray[Any], arranged: GapProblem, order: Index) -> NDArray[Any]:
    """Return values of the wanted entries (M,) of a problem in the order of the arranged one."""
    return entries[_rank_entries(arranged, order)]


def restore_entries(entries: NDArray[Any], arranged: GapProblem, order: Index) -> NDArray[Any]:
    """Return values of the wanted entries (M,) of an arranged problem in the order from before."""
    restored = np.empty_like(entries)
    restored[_rank_entries(arranged, order)] = entries
    return restored


def _rank_entries(arranged: GapProblem, order: Index) -> Index:
    """Return the place (M,) that each wanted entry of an arranged problem had before."""
    frames, channels = np.divmod(np.flatnonzero(arranged.target), len(order))
    return np.argsort(np.argsort(frames * len(order) + order[channels]))
