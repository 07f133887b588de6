"""A problem with the solutions of all entrants: what figures draw."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import Problem
from mocapbench.datasets import Archive

__all__ = ["Solved"]

P = TypeVar("P", bound=Problem)  # type: ignore[type-arg]
A = TypeVar("A")


@dataclass(frozen=True, eq=False)
class Solved(Generic[P, A]):
    """One problem of a task, with the solutions of all entrants.

    Parameters
    ----------
    task : str
        The task's name.
    problem : Problem
    solutions : mapping of str to solution
        By label, as `Problem.solve` returns them.
    internals : mapping of str to mapping of str to ndarray
        By label, the arrays that ``internals_of`` returns, and maybe others.
    papers : collection of str
        The labels that stand for models of the papers.
    ranking : sequence of str
        The labels, best first by the task's first metric on this problem.
    metric : str
        Title of that metric.
    interpolations : collection of str
        The labels that fill each channel from its own course alone.
    archive : Archive or None
        Where skeletons are, for bodies that the problem does not state.
    """

    task: str
    problem: P
    solutions: Mapping[str, A]
    internals: Mapping[str, Arrays] = field(default_factory=dict)
    papers: Collection[str] = ()
    ranking: Sequence[str] = ()
    metric: str = ""
    interpolations: Collection[str] = ()
    archive: Archive | None = None
