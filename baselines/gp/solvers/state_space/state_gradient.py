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
from mocapbench.baselines.gp.solvers.state_space.passes import (
    FilterPass,
    Message,
    StateMoments,
    backward_pass,
)
from mocapbench.baselines.gp.solvers.state_space.state_model import StateModel
from mocapbench.basics.arrays import Array

__all__ = ["state_gradient"]


def state_gradient(filtered: FilterPass) -> Parameters:
    """Return the gradient of the log-density of the filtered block."""
    model, block, parameters = filtered.model, filtered.block, filtered.parameters
    scales, matrices = np.zeros(len(model.matrices)), np.zeros_like(model.matrices)
    noise = np.zeros(block.observed.shape)
    frames = zip(reversed(range(len(block.times))), backward_pass(filtered), strict=True)
    for t, (alpha, precision, before) in frames:
        # The step into frame t: its terms of ∂ log ℓ_j and B̄_j.
        by_scale, by_matrix = _step_gradient(filtered, t, before)
        scales += by_scale
        matrices += by_matrix
        # The diagonal of K̄ at the frame's visible entries: ½ (Σ_r u² − ρ D).
        noise[..., t].flat[filtered.entries[t]] = 0.5 * (
            np.square(alpha).sum(axis=1) - block.multiplicity * np.diagonal(precision)
        )
    # From chains to layers, and from K̄ to ∂ log β_d.
    layers = {name: layer.zeros() for name, layer in parameters.layers.items()}
    layers |= model.pull_back(scales, matrices)
    by_output = (noise * block.noise_scale).sum(axis=(0, 2))
    return Parameters(layers, parameters.noise * by_output)


def _step_gradient(filtered: FilterPass, t: int, before: Message) -> tuple[Array, Array]:
    """Return the terms of the gradients in log ℓ_j, (J,), and B_j, (J, D, D), of one step."""
    rho = filtered.block.multiplicity
    transition, noise, transition_gradient, noise_gradient = filtered.steps[:, t]
    # Ē of each chain, and the adjoints of Q (summed against B) and of Φ.
    adjoint = _noise_adjoint(filtered.model, before, rho)
    by_noise = np.einsum("jcdef,jdf->jce", adjoint, filtered.model.matrices)
    by_transition = _transition_adjoint(filtered.model, filtered.states[t], transition, before, rho)
    # ⟨Q̄, ∂Q⟩ + ⟨Φ̄, ∂Φ⟩, entry by entry, and B̄_j = ⟨Ē, Q⟩.
    by_scale = by_noise * noise_gradient + by_transition * transition_gradient
    by_matrix = np.einsum("jcdef,jce->jdf", adjoint, noise)
    return by_scale.sum(axis=(1, 2)), by_matrix


def _noise_adjoint(model: StateModel, before: Message, rho: int) -> Array:
    """Return the blocks of Ē that belong to single chains, (J, m, D, m, D)."""
    (score, information), (n_chains, order, n_outputs) = before, model.shape
    chain = np.arange(n_chains)
    information = information.reshape(*model.shape, *model.shape)[chain, :, :, chain]
    score = score.reshape(n_chains, order * n_outputs, -1)
    outer = (score @ score.transpose(0, 2, 1)).reshape(information.shape)
    return np.asarray(0.5 * (outer - rho * information))


def _transition_adjoint(
    model: StateModel, state: StateMoments, transition: Array, before: Message, rho: int
) -> Array:
    """Return Φ̄ = Σ_r r⁻ (x + P Φᵀ r⁻)ᵀ − ρ N⁻ Φ P of each chain, (J, m, m)."""
    (mean, covariance), by_chain = state, (*model.shape[:2], -1)
    # P Φᵀ, and with it the smoothed mean of the state before the step.
    cross = model.propagate(transition, covariance).T
    smoothed = (mean + cross @ before[0]).reshape(by_chain)
    back = cross.reshape(by_chain)
    score, information = (each.reshape(by_chain) for each in before)
    return np.asarray(
        score @ smoothed.transpose(0, 2, 1) - rho * information @ back.transpose(0, 2, 1)
    )
