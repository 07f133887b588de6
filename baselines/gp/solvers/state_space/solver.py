r"""Inference by passing through time once forward and once backward.

A Matérn kernel of half-integer order is the covariance of a Markov process (`markov`), so a block
is a linear Gaussian state-space model (`chains`, `state_model`): a Kalman filter gives the
log-density (`filtering`), a backward pass the posterior (`hindsight`) and the gradient
(`state_gradient`). The cost is linear in the number of frames. Irregular times and masks cost
nothing; nor do further data vectors, since covariances are common to all.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.markov import is_markov
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Posterior, Solver
from mocapbench.baselines.gp.solvers.state_space.filter import Filtered
from mocapbench.baselines.gp.solvers.state_space.gradient import state_gradient
from mocapbench.baselines.gp.solvers.state_space.model import StateModel
from mocapbench.baselines.gp.solvers.state_space.smoother import Hindsight, look_back

__all__ = ["StateSpace"]

Array = NDArray[np.float64]

OVERHEAD = 2e6
"""What a frame costs besides its matrix products, as operations (about 0.13 milliseconds)."""


class StateSpace(Solver):
    """O(n s²) in visible entries n and the length s of the state: for many frames.

    `evaluate` and `condition` raise a ValueError for kernels that have no finite state.
    """

    name: ClassVar[str] = "state-space"
    needs: ClassVar[str] = "a Matérn kernel"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        filtered = Filtered.of(self.kernel, block, parameters)
        return filtered.log_density, state_gradient(filtered)

    def condition(self, block: Block, parameters: Parameters) -> Posterior:
        """Return the posterior given the block's data."""
        return _StateSpacePosterior(Filtered.of(self.kernel, block, parameters))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 5 n s², n visible entries, and an overhead; infinite without a finite state."""
        if not is_markov(self.kernel):
            return np.inf
        size = StateModel.of(self.kernel, block, parameters).size
        return 5.0 * block.n_visible * float(size) ** 2 + len(block.times) * OVERHEAD


class _StateSpacePosterior(Posterior):
    r"""Where the belief from the past meets the hindsight of the future.

    At any time, on the grid or not, let (x, P) be the last frame's belief carried forward and
    (r, N) the next frame's hindsight carried back. The state has mean :math:`x + P r` and
    covariance :math:`P - P N P`.
    """

    def __init__(self, filtered: Filtered) -> None:
        self.filtered = filtered
        none = Hindsight.none(filtered.model, len(filtered.block.data))
        corrections = [correction.before for correction in look_back(filtered)]
        self.hindsights = [*corrections[::-1], none]

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        block, model = self.filtered.block, self.filtered.model
        knots = np.concatenate([[-np.inf], block.times, [np.inf]])
        last = np.searchsorted(block.times, times, side="right")
        since, until = model.steps(times - knots[last]), model.steps(knots[last + 1] - times)
        loadings = model.chains.coefficients(target)[None]
        shape = (len(times), model.shape[2])
        means, variances = np.empty((*shape, len(block.data))), np.empty(shape)
        for m, i in enumerate(last):
            belief = self.filtered.beliefs[i].carried(model, since.transition[m], since.noise[m])
            hindsight = self.hindsights[i].across(model, until.transition[m])
            cross = model.read(loadings, belief.covariance)
            means[m] = model.read(loadings, belief.mean) + cross @ hindsight.score
            variances[m] = np.diagonal(model.read(loadings, cross.T))
            variances[m] -= np.einsum("ds,ds->d", cross @ hindsight.information, cross)
        variance = np.maximum(variances.T, 0.0) + self._fresh(target)[:, None]
        return means.transpose(2, 1, 0), block.share_of_variance * variance

    def _fresh(self, target: Target) -> Array:
        """Return (D,), the variance of the target's independent part."""
        return np.asarray(
            sum(
                target.fresh.get(name, 0.0) * layer.coregionalisation.variances
                for name, layer in self.filtered.model.chains.layers.items()
            )
        )
