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
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.solvers.state_space.filter import FilterPass, Innovation
from mocapbench.baselines.gp.solvers.state_space.model import StateModel
from mocapbench.basics.arrays import Array

__all__ = ["BackwardMessage", "SmoothingStep", "backward_pass"]


@dataclass(frozen=True, eq=False)
class BackwardMessage:
    """The log-density of later data as a function of the state, to second order.

    Parameters
    ----------
    score : ndarray of shape (s, h)
        r, its derivative in the state's mean x, a column for each data vector.
    information : ndarray of shape (s, s)
        N, minus its second derivative.
    """

    score: Array
    information: Array

    @classmethod
    def none(cls, model: StateModel, n_vectors: int) -> BackwardMessage:
        """Return the message where there are no later data: zeros."""
        return cls(np.zeros((model.size, n_vectors)), np.zeros((model.size, model.size)))

    def across(self, model: StateModel, transition: Array) -> BackwardMessage:
        """Return Φᵀ r, Φᵀ N Φ; ``transition`` is (J, m, m)."""
        back = transition.swapaxes(1, 2)
        half = model.propagate(back, self.information)
        return BackwardMessage(model.propagate(back, self.score), model.propagate(back, half.T))


@dataclass(frozen=True, eq=False)
class SmoothingStep:
    """A frame's part of K⁻¹ z and of K⁻¹, and the message to the time just before the frame.

    Parameters
    ----------
    alpha : ndarray of shape (V, h)
        u.
    precision : ndarray of shape (V, V)
        D.
    before : BackwardMessage
        r⁻ and N⁻.
    """

    alpha: Array
    precision: Array
    before: BackwardMessage


def backward_pass(filtered: FilterPass) -> Iterator[SmoothingStep]:
    """Yield the smoothing step of every frame, from the last to the first."""
    model = filtered.model
    after = BackwardMessage.none(model, len(filtered.block.data))
    steps_into = zip(filtered.innovations, filtered.steps.transition, strict=True)
    for innovation, transition in reversed(list(steps_into)):
        step = _smooth(model, innovation, after)
        yield step
        after = step.before.across(model, transition)


def _smooth(model: StateModel, innovation: Innovation, after: BackwardMessage) -> SmoothingStep:
    whitening = innovation.whitening
    # The gain K = Aᵀ L⁻¹, and Kᵀ N.
    gain = innovation.explained.T @ whitening
    informed = gain.T @ after.information
    # u = S⁻¹ e − Kᵀ r and D = S⁻¹ + Kᵀ N K.
    alpha = whitening.T @ innovation.white - gain.T @ after.score
    precision = whitening.T @ whitening + informed @ gain
    # N⁻ = N − half − halfᵀ with half = Hᵀ Kᵀ N − ½ Hᵀ D H.
    half = _observe_adjoint(
        model, innovation, informed - 0.5 * _observe_adjoint(model, innovation, precision).T
    )
    before = BackwardMessage(
        after.score + _observe_adjoint(model, innovation, alpha),
        after.information - half - half.T,
    )
    return SmoothingStep(alpha, precision, before)


def _observe_adjoint(model: StateModel, innovation: Innovation, visible: Array) -> Array:
    """Return Hᵀ y, (s, k), for the visible entries y (V, k)."""
    entries = np.zeros((len(model.units) * model.shape[2], visible.shape[1]))
    entries[innovation.entries] = visible
    return model.observe_adjoint(model.units, entries)
