r"""Inference by one pass forward and one pass backward through time.

A Matérn kernel of half-integer order is the covariance of a Markov process
(`mocapbench.baselines.gp.prior.markov`), so a block is a linear Gaussian state-space model
(`state_model`). A Kalman filter gives the log-density, a backward pass the posterior (`passes`),
and both together the gradient (`state_gradient`): docs/mathematics/solvers.md, section 6. The cost
is linear in the number of frames. Irregular times and hidden entries cost nothing extra, and
further data vectors little, because all data vectors have the same covariances.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mocapbench.baselines.gp.prior.markov import is_markov
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver
from mocapbench.baselines.gp.solvers.state_space.passes import (
    FilterPass,
    backward_pass,
    carry_back,
    no_message,
    predict_state,
)
from mocapbench.baselines.gp.solvers.state_space.state_gradient import state_gradient
from mocapbench.baselines.gp.solvers.state_space.state_model import StateModel
from mocapbench.basics.arrays import Array

__all__ = ["StateSpace"]


OVERHEAD = 2e6
"""Cost of a frame apart from its matrix products, in operations (about 0.13 milliseconds)."""


class StateSpace(Solver):
    """Cost O(n s²) for n visible entries and a state of length s: the choice for many frames.

    `evaluate` and `condition` raise a ValueError for kernels that have no finite state.
    """

    name: ClassVar[str] = "state-space"
    needs: ClassVar[str] = "a Matérn kernel"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        filtered = FilterPass.of(self.kernel, block, parameters)
        return filtered.log_density, state_gradient(filtered)

    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data."""
        return _StateSpacePosterior(FilterPass.of(self.kernel, block, parameters))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 5 n s² plus an overhead; infinity if the kernel has no finite state."""
        if not is_markov(self.kernel):
            return np.inf
        size = StateModel.of(self.kernel, block, parameters).size
        return 5.0 * block.n_visible * float(size) ** 2 + len(block.times) * OVERHEAD


class _StateSpacePosterior(BlockPosterior):
    r"""The smoothed state at any time, on the grid or not.

    Let (x, P) be the filtered state of the last frame before that time, predicted forward to it,
    and (r, N) the backward message of the next frame, carried back to it. The smoothed state has
    mean :math:`x + P r` and covariance :math:`P - P N P`.
    """

    def __init__(self, filtered: FilterPass) -> None:
        self.filtered = filtered
        latest_first = [before for _, _, before in backward_pass(filtered)]
        last = no_message(filtered.model, len(filtered.block.data))
        self.messages = [*latest_first[::-1], last]

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        block, model = self.filtered.block, self.filtered.model
        knots = np.concatenate([[-np.inf], block.times, [np.inf]])
        # The frames before and after each time, and the steps from and to them.
        last = np.searchsorted(block.times, times, side="right")
        since, noise, *_ = model.steps(times - knots[last])
        until, *_ = model.steps(knots[last + 1] - times)
        loadings = model.coefficients(target)[None]
        shape = (len(times), model.shape[2])
        means, variances = np.empty((*shape, len(block.data))), np.empty(shape)
        for m, i in enumerate(last):
            mean, covariance = predict_state(model, since[m], noise[m], self.filtered.states[i])
            score, information = carry_back(model, until[m], self.messages[i])
            # H P, the mean H (x + P r) and the variance diag(H P Hᵀ − H P N P Hᵀ).
            cross = model.observe(loadings, covariance)
            means[m] = model.observe(loadings, mean) + cross @ score
            variances[m] = np.diagonal(model.observe(loadings, cross.T))
            variances[m] -= np.einsum("ds,ds->d", cross @ information, cross)
        variance = np.maximum(variances.T, 0.0) + self._independent_variance(target)[:, None]
        return means.transpose(2, 1, 0), block.variance_scale * variance

    def _independent_variance(self, target: Target) -> Array:
        """Return the variance of the target's independent draw, (D,)."""
        return np.asarray(
            sum(
                target.independent_variance.get(name, 0.0) * layer.variances
                for name, layer in self.filtered.model.layers.items()
            )
        )
