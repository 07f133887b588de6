"""The problem of finding a process's covariances again from what it drew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Layered
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem, Solution
from mocapbench.datasets import Frames, ToyProcess
from mocapbench.metrics import Recovery

__all__ = ["LAYERS", "RecoverProblem"]

LAYERS = ("parent", "child")
"""The layers of a `ToyProcess`, outermost first."""


@dataclass(frozen=True, eq=False)
class RecoverProblem(Problem):
    """Find the covariances of the process that drew the training recordings.

    Parameters
    ----------
    process : ToyProcess
        The process; no model that is asked is told it.
    times : ndarray of shape (N,)
        Where the covariances are compared.
    """

    process: ToyProcess
    times: Frames

    def solve(self, model: Layered, random_state: int) -> Solution:
        """Return ``covariance-child`` and, of a model with two layers, ``covariance-parent``.

        Layers are paired from the innermost outwards: the one kernel of a model without a
        hierarchy stands for the children's, as in the thesis (§5.2.3).
        """
        del random_state  # all is said in fit
        paired = zip(reversed(LAYERS), reversed(model.layers), strict=False)
        return {f"covariance-{layer}": self._covariance(model, own) for layer, own in paired}

    def outcome(self, solution: Solution) -> Recovery:
        """Set the covariances beside those of the process."""
        names = {layer: f"covariance-{layer}" for layer in LAYERS}
        return Recovery(
            truth=self.truth,
            estimate={layer: solution[name] for layer, name in names.items() if name in solution},
            noise=self.process.noise,
        )

    @property
    def truth(self) -> dict[str, NDArray[np.float64]]:
        """The process's covariances (D N, D N) by layer, outputs slowest."""
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
