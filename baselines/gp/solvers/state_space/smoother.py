r"""The smoother: the backward pass through time.

Let :math:`r^-` and :math:`N^-` be the score and the information of the data from frame t on, in
the state before it, and :math:`r` and :math:`N` those of the data after it. They follow de Jong's
recursion. With the gain :math:`K = A^\top L^{-1}`,

.. math:: u = S^{-1} e - K^\top r, \quad D = S^{-1} + K^\top N K, \quad
          r^- = r + H^\top u, \quad
          N^- = N - H^\top K^\top N - N K H + H^\top D H,

and across a step :math:`r = \Phi^\top r^-`, :math:`N = \Phi^\top N^- \Phi`. Here u is the frame's
part of :math:`\alpha = K^{-1} z` and D its diagonal block of :math:`K^{-1}`. A filtered state
:math:`(x, P)` becomes the smoothed :math:`(x + P r,\; P - P N P)`. No matrix but S is inverted, so
frames may be arbitrarily close (docs/mathematics/solvers.md, section 6).

References
----------
de Jong, P. (1989). Smoothing and interpolation with the state-space model. Journal of the
American Statistical Association 84.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mocapbench.baselines.gp.solvers.state_space.filter import FilterPass
from mocapbench.baselines.gp.solvers.state_space.state_model import StateModel
from mocapbench.basics.arrays import Array, Index

__all__ = ["Message", "backward_pass", "carry_back", "no_message"]

Message = tuple[Array, Array]
"""The log-density of later data as a function of the state, to second order.

The score r (s, h) is its derivative in the state's mean x, a column for each data vector; the
information N (s, s) is minus its second derivative."""


def no_message(model: StateModel, n_vectors: int) -> Message:
    """Return the message where there are no later data: zeros."""
    return np.zeros((model.size, n_vectors)), np.zeros((model.size, model.size))


def carry_back(model: StateModel, transition: Array, message: Message) -> Message:
    """Return Φᵀ r, Φᵀ N Φ; ``transition`` is (J, m, m)."""
    (score, information), back = message, transition.swapaxes(1, 2)
    half = model.propagate(back, information)
    return model.propagate(back, score), model.propagate(back, half.T)


def backward_pass(filtered: FilterPass) -> Iterator[tuple[Array, Array, Message]]:
    """Yield u (V, h), D (V, V) and the message r⁻, N⁻ of every frame, from last to first."""
    model = filtered.model
    after = no_message(model, len(filtered.block.data))
    for t in reversed(range(len(filtered.white))):
        alpha, precision, before = _smooth_frame(filtered, t, after)
        yield alpha, precision, before
        after = carry_back(model, filtered.steps[0, t], before)


def _smooth_frame(filtered: FilterPass, t: int, after: Message) -> tuple[Array, Array, Message]:
    """Return a frame's parts of K⁻¹ z and of K⁻¹, and the message to the time just before it."""
    model, entries, whitening = filtered.model, filtered.entries[t], filtered.whitening[t]
    score, information = after
    # The gain K = Aᵀ L⁻¹, and Kᵀ N.
    gain = filtered.explained[t].T @ whitening
    informed = gain.T @ information
    # u = S⁻¹ e − Kᵀ r and D = S⁻¹ + Kᵀ N K.
    alpha = whitening.T @ filtered.white[t] - gain.T @ score
    precision = whitening.T @ whitening + informed @ gain
    # N⁻ = N − half − halfᵀ with half = Hᵀ Kᵀ N − ½ Hᵀ D H, and r⁻ = r + Hᵀ u.
    half = _observe_adjoint(
        model, entries, informed - 0.5 * _observe_adjoint(model, entries, precision).T
    )
    before = score + _observe_adjoint(model, entries, alpha), information - half - half.T
    return alpha, precision, before


def _observe_adjoint(model: StateModel, entries: Index, visible: Array) -> Array:
    """Return Hᵀ y, (s, k), for the visible entries y (V, k) at their indices (V,)."""
    frame = np.zeros((len(model.units) * model.shape[2], visible.shape[1]))
    frame[entries] = visible
    return model.observe_adjoint(model.units, frame)
