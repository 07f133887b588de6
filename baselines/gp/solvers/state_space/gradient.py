r"""The gradient of the log-density from the two passes of the state-space solver.

By Fisher's identity the gradient needs only the smoothed moments of the noise that drives the
states (docs/mathematics/solvers.md, section 6). With
:math:`\bar E = \tfrac12 (\sum_r r^- r^{-\top} - \rho N^-)` the adjoint of a step's noise
:math:`Q \otimes B`, and x, P the filtered state before the step,

.. math::
   \partial B_j &= \sum_t \langle \bar E, Q_j \rangle, \\
   \partial \log \ell_j &= \sum_t \langle \bar E, \partial Q_j \otimes B_j \rangle
   + \sum_t \Big\langle \sum_r r^- (x + P \Phi^\top r^-)^\top - \rho N^- \Phi P,\;
   \partial\Phi_j \Big\rangle,

of which only the blocks of single chains are computed. The adjoint of the observation noise of
an entry is :math:`\tfrac12 (\sum_r u^2 - \rho D)`.

References
----------
Koopman, S. J. and Shephard, N. (1992). Exact score for time series models in state space form.
Biometrika 79.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.state_space.filter import FilteredState, FilterPass
from mocapbench.baselines.gp.solvers.state_space.model import StateModel
from mocapbench.baselines.gp.solvers.state_space.smoother import BackwardMessage, backward_pass
from mocapbench.basics.arrays import Array

__all__ = ["state_gradient"]


def state_gradient(filtered: FilterPass) -> Parameters:
    """Return the gradient of the log-density of the filtered block."""
    model, block, parameters = filtered.model, filtered.block, filtered.parameters
    scales, matrices = np.zeros(len(model.matrices)), np.zeros_like(model.matrices)
    noise = np.zeros(block.observed.shape)
    for t, smoothed in zip(reversed(range(len(block.times))), backward_pass(filtered), strict=True):
        # The step into frame t: its terms of ∂ log ℓ_j and B̄_j.
        by_scale, by_matrix = _step_gradient(filtered, t, smoothed.before)
        scales += by_scale
        matrices += by_matrix
        # The diagonal of K̄ at the frame's visible entries: ½ (Σ_r u² − ρ D).
        noise[..., t].flat[filtered.innovations[t].entries] = 0.5 * (
            np.square(smoothed.alpha).sum(axis=1)
            - block.multiplicity * np.diagonal(smoothed.precision)
        )
    # From chains to layers, and from K̄ to ∂ log β_d.
    layers = {name: layer.zeros() for name, layer in parameters.layers.items()}
    layers |= model.chains.pull_back(scales, matrices)
    by_output = (noise * block.noise_scale).sum(axis=(0, 2))
    return Parameters(layers, parameters.noise * by_output)


def _step_gradient(filtered: FilterPass, t: int, before: BackwardMessage) -> tuple[Array, Array]:
    """Return the terms of the gradients in log ℓ_j, (J,), and B_j, (J, D, D), of one step."""
    steps, rho = filtered.steps, filtered.block.multiplicity
    # Ē of each chain, and the adjoints of Q (summed against B) and of Φ.
    adjoint = _noise_adjoint(filtered.model, before, rho)
    by_noise = np.einsum("jcdef,jdf->jce", adjoint, filtered.model.matrices)
    by_transition = _transition_adjoint(
        filtered.model, filtered.states[t], steps.transition[t], before, rho
    )
    # ⟨Q̄, ∂Q⟩ + ⟨Φ̄, ∂Φ⟩, entry by entry, and B̄_j = ⟨Ē, Q⟩.
    by_scale = by_noise * steps.noise_gradient[t] + by_transition * steps.transition_gradient[t]
    by_matrix = np.einsum("jcdef,jce->jdf", adjoint, steps.noise[t])
    return by_scale.sum(axis=(1, 2)), by_matrix


def _noise_adjoint(model: StateModel, before: BackwardMessage, rho: int) -> Array:
    """Return the blocks of Ē that belong to single chains, (J, m, D, m, D)."""
    n_chains, order, n_outputs = model.shape
    chain = np.arange(n_chains)
    information = before.information.reshape(*model.shape, *model.shape)[chain, :, :, chain]
    score = before.score.reshape(n_chains, order * n_outputs, -1)
    outer = (score @ score.transpose(0, 2, 1)).reshape(information.shape)
    return np.asarray(0.5 * (outer - rho * information))


def _transition_adjoint(
    model: StateModel, state: FilteredState, transition: Array, before: BackwardMessage, rho: int
) -> Array:
    """Return Φ̄ = Σ_r r⁻ (x + P Φᵀ r⁻)ᵀ − ρ N⁻ Φ P of each chain, (J, m, m)."""
    # P Φᵀ, and with it the smoothed mean of the state before the step.
    cross = model.propagate(transition, state.covariance).T
    by_chain = (*model.shape[:2], -1)
    score, information = (x.reshape(by_chain) for x in (before.score, before.information))
    smoothed = (state.mean + cross @ before.score).reshape(by_chain)
    back = cross.reshape(by_chain)
    return np.asarray(
        score @ smoothed.transpose(0, 2, 1) - rho * information @ back.transpose(0, 2, 1)
    )
