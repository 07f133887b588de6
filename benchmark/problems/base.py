"""Problems: what a model may see, and apart from it what it may not.

A problem also knows how to put its question to a model (`Problem.solve`) and how to confront the
answer with the truth (`Problem.outcome`), so that nothing else asks of which kind it is. A
`Solution` is plain arrays by name, which the store keeps.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from mocapbench.baselines import Informed, Model
from mocapbench.datasets import Recording, ToyProcess
from mocapbench.metrics import Clustering, Imputation, Recovery, Synthesis

__all__ = ["InvalidPredictionError", "Problem", "Solution"]

Solution = Mapping[str, NDArray[Any]]


class InvalidPredictionError(ValueError):
    """A model answered with the wrong shape, a NaN, or a variance that is not positive."""


@dataclass(frozen=True, eq=False)
class Problem(ABC):
    """A question to a model, and its secret answer.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    process : ToyProcess or None
        The generating process, for models that must be told it.
    parent : Recording or None
        The curves g of the parent that a known process drew, which no model sees.
    """

    train: tuple[Recording, ...]
    process: ToyProcess | None
    parent: Recording | None = field(default=None, kw_only=True)

    def fit(self, model: Model) -> Model:
        """Fit ``model`` to what it may see."""
        if self.process is not None and isinstance(model, Informed):
            model.inform(self.process)
        return model.fit(self.train)

    @abstractmethod
    def solve(self, model: Any, random_state: int) -> Solution:
        """Put the question to a fitted model that has the abilities required.

        Raises
        ------
        InvalidPredictionError
            If the answer is not a valid one.
        """

    @abstractmethod
    def outcome(self, solution: Solution) -> Imputation | Synthesis | Clustering | Recovery:
        """Confront a solution with the truth."""
