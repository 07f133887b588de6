"""The problem of estimating the covariances of a known process from curves that it drew."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays, with_prefix
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem
from mocapbench.datasets import Frames, ToyProcess
from mocapbench.metrics import Recovery

if TYPE_CHECKING:
    from mocapbench.baselines import Layered

__all__ = ["LAYERS", "Covariances", "RecoverProblem"]

LAYERS = ("parent", "child")
"""The layers of a `ToyProcess`, outermost first."""


Covariances = Mapping[str, NDArray[np.float64]]
"""By layer, (D N, D N) without noise; ordered by output, then by frame."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RecoverProblem(Problem[Covariances]):
    """Find the covariances of the process that drew the training recordings.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    process : ToyProcess
        The process, which no model that enters is given.
    times : ndarray of shape (N,)
        Where the covariances are compared.
    """

    process: ToyProcess
    times: Frames

    def solve(self, model: Layered, random_state: int) -> Covariances:
        """Return the children's covariance and, of a model with two layers, the parent's.

        Layers are paired from the innermost outwards: the one kernel of a model without a
        hierarchy stands for the children's, as in the thesis (§5.2.3).
        """
        del random_state  # fit has done everything
        paired = zip(reversed(LAYERS), reversed(model.layers), strict=False)
        return {layer: self._covariance(model, own) for layer, own in paired}

    def outcome(self, solution: Covariances) -> Recovery:
        """Set the covariances beside those of the process."""
        estimate = {layer: solution[layer] for layer in LAYERS if layer in solution}
        return Recovery(truth=self.truth, estimate=estimate, noise=self.process.noise)

    def to_arrays(self, solution: Covariances) -> Arrays:
        """Return ``covariance-parent``, ``covariance-child`` …, by layer."""
        return {f"covariance-{layer}": matrix for layer, matrix in solution.items()}

    def from_arrays(self, arrays: Arrays) -> Covariances:
        """Return the solution that `to_arrays` turned into ``arrays``."""
        return with_prefix("covariance", arrays)

    @property
    def truth(self) -> dict[str, NDArray[np.float64]]:
        """The process's covariances (D N, D N) by layer; ordered by output, then frame."""
        return {
            "parent": self.process.parent.covariance(self.times),
            "child": self.process.child.covariance(self.times),
        }

    def _covariance(self, model: Layered, layer: str) -> NDArray[np.float64]:
        covariance = np.asarray(model.covariance(layer, self.times))
        n = self.process.n_outputs * len(self.times)
        if covariance.shape != (n, n) or not np.isfinite(covariance).all():
            raise InvalidPredictionError(
                f"covariance of {layer!r}: expected a finite matrix of shape {(n, n)}, got shape "
                f"{covariance.shape} with {int((~np.isfinite(covariance)).sum())} entries that "
                "are NaN or infinite"
            )
        return covariance
