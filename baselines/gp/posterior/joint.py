r"""The joint posterior of a curve at several times: its covariance, and draws from it.

Conditioning is linear in the data, so posterior means of suitable data vectors are all that is
needed of a solver (docs/mathematics/prediction.md, sections 8 and 9). A target of a block, with
values
:math:`f_*` at the requested times and cross covariance :math:`K_*` with the visible entries, has

* the posterior covariance :math:`\tfrac{\rho}{h}(K_{**} - K_* K^{-1} K_*^\top)`, where
  :math:`K_* K^{-1} K_*^\top` is the posterior mean given the columns of :math:`K_*^\top` as data;
* the posterior draw :math:`\sqrt{\rho/h}\, \tilde f_* + K_* K^{-1}(z - \sqrt{\rho/h}\, \tilde z)`,
  where :math:`(\tilde z, \tilde f_*)` is a draw of the data and the target from the prior.

The second is Matheron's rule (Wilson et al. 2021, *Pathwise Conditioning of Gaussian Processes*,
JMLR 22, Theorem 1). It needs draws of the layers at the times, but no joint covariance.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.gp.posterior.term import TermInference
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.basics.arrays import Array

__all__ = ["draw_curves", "joint_covariance"]


def joint_covariance(
    reduction: Reduction,
    solvers: Sequence[Solver],
    parameters: Parameters,
    terms: Sequence[PosteriorTerm],
    times: Array,
) -> Array:
    """Return the posterior covariance of a noise-free curve.

    The block of each term is conditioned once, on D M data vectors.

    Parameters
    ----------
    reduction : Reduction
        The likelihood as block problems.
    solvers : sequence of Solver
        One for each block.
    parameters : Parameters
        The parameters of the model.
    terms : sequence of PosteriorTerm
        The terms of the curve.
    times : ndarray of shape (M,)
        In any order.

    Returns
    -------
    ndarray of shape (D M, D M)
        Outputs are slowest. Symmetric, and positive semi-definite up to rounding.
    """
    size = len(parameters.log_noise) * len(times)
    total = np.zeros((size, size))
    for term in terms:
        block, solver = reduction.blocks[term.block], solvers[term.block]
        inference = TermInference(block, solver, parameters, term.target, times)
        # (ρ / h) (K_** − K_* K⁻¹ K_*ᵀ)
        explained = inference.mean_given(inference.cross()).reshape(size, size)
        total += block.variance_scale * (inference.prior() - explained)
    return 0.5 * (total + total.T)


def draw_curves(
    reduction: Reduction,
    solvers: Sequence[Solver],
    parameters: Parameters,
    terms: Sequence[PosteriorTerm],
    times: Array,
    *,
    n_samples: int,
    rng: np.random.Generator,
) -> Array:
    """Return posterior draws of a noise-free curve.

    The block of each term is conditioned once, on ``n_samples`` data vectors. The draws of a seed
    depend on the set of times, but not on their order, nor on the solvers except for rounding.

    Parameters
    ----------
    reduction : Reduction
        The likelihood as block problems.
    solvers : sequence of Solver
        One for each block.
    parameters : Parameters
        The parameters of the model.
    terms : sequence of PosteriorTerm
        The terms of the curve.
    times : ndarray of shape (M,)
        In any order.
    n_samples : int
        The number of draws.
    rng : numpy.random.Generator
        Source of the draws.

    Returns
    -------
    ndarray of shape (n_samples, M, D)
        Equal times get equal values.
    """
    total = np.zeros((n_samples, len(times), len(parameters.log_noise)))
    for term in terms:
        block, solver = reduction.blocks[term.block], solvers[term.block]
        inference = TermInference(block, solver, parameters, term.target, times)
        # √(ρ/h) f̃_* + K_* K⁻¹ (z − √(ρ/h) z̃)
        data, curves = inference.simulate(n_samples, rng)
        scale = np.sqrt(block.variance_scale)
        correction = inference.mean_given(block.data[term.column] - scale * data)
        total += scale * curves + correction.transpose(0, 2, 1)
    return total
