r"""Backward in time: what later frames say of the state.

The log-density of the data from frame t on depends on the belief before it by its score
:math:`r^-` and information :math:`N^-`, which collect backwards (de Jong's recursion). With the
gain :math:`K = A^\top L^{-1}` and, after the frame, :math:`r` and :math:`N`,

.. math:: u = S^{-1} e - K^\top r, \quad D = S^{-1} + K^\top N K, \quad
          r^- = r + H^\top u, \quad
          N^- = N - H^\top K^\top N - N K H + H^\top D H,

and across a step :math:`r = \Phi^\top r^-`, :math:`N = \Phi^\top N^- \Phi`. Here u is the frame's
part of :math:`\alpha = K^{-1} z` and D its diagonal block of :math:`K^{-1}`. A belief
:math:`(x, P)` becomes :math:`(x + P r,\; P - P N P)` in hindsight. Nothing but S is ever inverted,
so frames may be arbitrarily close.

References
----------
de Jong, P. (1989). Smoothing and interpolation with the state-space model. JASA 84.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.solvers.state_space.filter import Filtered, Innovation
from mocapbench.baselines.gp.solvers.state_space.model import StateModel

__all__ = ["Correction", "Hindsight", "look_back"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Hindsight:
    """What later data say about a belief.

    Parameters
    ----------
    score : ndarray of shape (s, h)
        r, the derivative of their log-density in x, a column for each data vector.
    information : ndarray of shape (s, s)
        N, minus the second derivative.
    """

    score: Array
    information: Array

    @classmethod
    def none(cls, model: StateModel, n_vectors: int) -> Hindsight:
        """Return that of no data."""
        return cls(np.zeros((model.size, n_vectors)), np.zeros((model.size, model.size)))

    def across(self, model: StateModel, transition: Array) -> Hindsight:
        """Return Φᵀ r, Φᵀ N Φ; ``transition`` is (J, m, m)."""
        back = transition.swapaxes(1, 2)
        half = model.propagate(back, self.information)
        return Hindsight(model.propagate(back, self.score), model.propagate(back, half.T))


@dataclass(frozen=True, eq=False)
class Correction:
    """A frame's part of K⁻¹ z and of K⁻¹, and the hindsight from just before the frame.

    Parameters
    ----------
    alpha : ndarray of shape (V, h)
        u.
    precision : ndarray of shape (V, V)
        D.
    before : Hindsight
        r⁻ and N⁻.
    """

    alpha: Array
    precision: Array
    before: Hindsight


def look_back(filtered: Filtered) -> Iterator[Correction]:
    """Yield the corrections of the frames, from the last to the first."""
    model = filtered.model
    after = Hindsight.none(model, len(filtered.block.data))
    steps_into = zip(filtered.innovations, filtered.steps.transition, strict=True)
    for innovation, transition in reversed(list(steps_into)):
        correction = _correct(model, innovation, after)
        yield correction
        after = correction.before.across(model, transition)


def _correct(model: StateModel, innovation: Innovation, after: Hindsight) -> Correction:
    whitening = innovation.whitening
    gain = innovation.explained.T @ whitening
    seen = gain.T @ after.information
    alpha = whitening.T @ innovation.white - gain.T @ after.score
    precision = whitening.T @ whitening + seen @ gain
    half = _write(model, innovation, seen - 0.5 * _write(model, innovation, precision).T)
    before = Hindsight(
        after.score + _write(model, innovation, alpha), after.information - half - half.T
    )
    return Correction(alpha, precision, before)


def _write(model: StateModel, innovation: Innovation, visible: Array) -> Array:
    """Return Hᵀ y, (s, k), for the visible entries y (V, k)."""
    entries = np.zeros((len(model.units) * model.shape[2], visible.shape[1]))
    entries[innovation.entries] = visible
    return model.write(model.units, entries)
