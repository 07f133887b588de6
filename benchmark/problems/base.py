"""Problems: what a model may see, and apart from it what it may not.

A problem asks a model for its solution (`Problem.solve`) and compares it with the truth
(`Problem.outcome`), so that no other module needs to know of which kind it is. It also turns
solutions into plain arrays for the store, and back.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from mocapbench.baselines.declarations.needs import list_given
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.datasets import Recording, ToyProcess
from mocapbench.metrics import Clustering, Imputation, Recovery, Synthesis

if TYPE_CHECKING:
    from mocapbench.baselines import Model

__all__ = ["InvalidPredictionError", "Problem"]


class InvalidPredictionError(ValueError):
    """A model returned the wrong shape, a NaN, or a variance that is not positive."""


A = TypeVar("A")
"""The type of a solution."""


@dataclass(frozen=True, eq=False)
class Problem(ABC, Generic[A]):
    """What a model is asked to do, and the truth, which it does not see.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    process : ToyProcess or None
        The process that generated them, for models that need it.
    control : ToyProcess or None
        A process that generated none of them, for models that need it.
    parent : Recording or None
        The curves g of the parent that a known process drew, which no model sees.
    """

    train: tuple[Recording, ...]
    process: ToyProcess | None = field(default=None, kw_only=True)
    control: ToyProcess | None = field(default=None, kw_only=True)
    parent: Recording | None = field(default=None, kw_only=True)

    def fit(self, model: Any) -> Model:
        """Fit ``model`` to what it may see, and give it what it needs besides."""
        fitted: Model = model.fit(self.train, **list_given(model.needs, self))
        return fitted

    @abstractmethod
    def solve(self, model: Any, random_state: int) -> A:
        """Return the solution of a fitted model that has the abilities required.

        Raises
        ------
        InvalidPredictionError
            If the solution is not a valid one.
        """

    @abstractmethod
    def outcome(self, solution: A) -> Imputation | Synthesis | Clustering | Recovery:
        """Compare a solution with the truth."""

    @abstractmethod
    def to_arrays(self, solution: A) -> Arrays:
        """Return a solution as arrays by name."""

    @abstractmethod
    def from_arrays(self, arrays: Arrays) -> A:
        """Return the solution that `to_arrays` turned into ``arrays``; other names are ignored."""
