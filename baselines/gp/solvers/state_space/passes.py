r"""The two passes through time: the Kalman filter forwards, the smoother backwards.

At frame t the state is predicted, :math:`x^- = \Phi x`, :math:`P^- = \Phi P \Phi^\top + Q`, and
then updated with the visible entries. Their innovations e are independent of all earlier data:

.. math:: e = z - H x^-, \quad S = H P^- H^\top + R = L L^\top, \quad A = L^{-1} H P^-, \quad
          x = x^- + A^\top L^{-1} e, \quad P = P^- - A^\top A.

Hence :math:`\log|K| = \sum_t \log|S_t|` and :math:`z^\top K^{-1} z = \sum_t |L_t^{-1} e_t|^2`, a
sum of squares. The covariances are common to all data vectors.

On the way back, let :math:`r^-` and :math:`N^-` be the score and the information of the data from
frame t on, in the state before it, and :math:`r` and :math:`N` those of the data after it. They
follow de Jong's recursion. With the gain :math:`K = A^\top L^{-1}`,

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
from scipy.linalg import lapack

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.solver import refuse_singular
from mocapbench.baselines.gp.solvers.state_space.state_model import StateModel
from mocapbench.basics.arrays import Array, Index

__all__ = [
    "FilterPass",
    "Message",
    "StateMoments",
    "backward_pass",
    "carry_back",
    "no_message",
    "predict_state",
]

StateMoments = tuple[Array, Array]
"""The mean x (s, h) of the state, a column for each data vector, and its covariance P (s, s)."""


@dataclass(frozen=True, eq=False)
class FilterPass:
    """The result of filtering a block.

    Parameters
    ----------
    model : StateModel
        The block as a state-space model.
    block : Block
        The problem, without frames in which nothing is visible.
    parameters : Parameters
        The parameters at which it is evaluated.
    steps : ndarray of shape (4, N, J, m, m)
        Φ, Q and their derivatives for the step into each of the N frames; the first starts from the
        stationary distribution.
    states : list of tuple of ndarray
        N + 1 of them: before the first frame, after the first, …, after the last.
    entries : list of ndarray, each of shape (V,)
        The indices of each frame's visible entries among its P D entries.
    whitening : list of ndarray, each of shape (V, V)
        L⁻¹ of each frame.
    white : list of ndarray, each of shape (V, h)
        L⁻¹ e of each frame.
    explained : list of ndarray, each of shape (V, s)
        A of each frame.
    """

    model: StateModel
    block: Block
    parameters: Parameters
    steps: Array
    states: list[StateMoments]
    entries: list[Index]
    whitening: list[Array]
    white: list[Array]
    explained: list[Array]

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> FilterPass:
        """Filter ``block`` at ``parameters``.

        Raises
        ------
        SingularCovarianceError
            If the covariance S of an innovation is not numerically positive definite.
        """
        block = block.trim()
        model = StateModel.of(kernel, block, parameters)
        steps = model.steps(np.diff(block.times, prepend=-np.inf))
        size, n_vectors = model.size, len(block.data)
        states: list[StateMoments] = [(np.zeros((size, n_vectors)), np.zeros((size, size)))]
        innovations = []
        for t, (transition, noise) in enumerate(zip(*steps[:2], strict=True)):
            predicted = predict_state(model, transition, noise, states[-1])
            innovations.append(_innovate(model, block, parameters, predicted, t))
            _, _, white, explained = innovations[-1]
            states.append(_update_state(predicted, white, explained))
        columns = [list(column) for column in zip(*innovations, strict=True)]
        return cls(model, block, parameters, steps, states, *columns)

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        log_roots = sum(np.log(np.diagonal(whitening)).sum() for whitening in self.whitening)
        squares = sum(np.vdot(white, white) for white in self.white)
        log_scale = self.block.n_visible * np.log(2.0 * np.pi) - 2.0 * log_roots
        return float(-0.5 * (self.block.multiplicity * log_scale + squares))


def predict_state(
    model: StateModel, transition: Array, noise: Array, state: StateMoments
) -> StateMoments:
    """Return the prediction Φ x, Φ P Φᵀ + Q ⊗ B; ``transition`` and ``noise`` are (J, m, m)."""
    mean, covariance = state
    return (
        model.propagate(transition, mean),
        model.predict_covariance(transition, noise, covariance),
    )


def _update_state(predicted: StateMoments, white: Array, explained: Array) -> StateMoments:
    """Return the update x + Aᵀ L⁻¹ e, P − Aᵀ A."""
    mean, covariance = predicted
    return mean + explained.T @ white, covariance - explained.T @ explained


def _innovate(
    model: StateModel, block: Block, parameters: Parameters, predicted: StateMoments, t: int
) -> tuple[Index, Array, Array, Array]:
    """Return the visible entries of frame t, L⁻¹, L⁻¹ e and A, given the predicted x⁻, P⁻."""
    mean, prior = predicted
    # H P⁻ and S = H P⁻ Hᵀ + R of the visible entries.
    entries = np.flatnonzero(block.observed[..., t])
    cross = model.observe(model.units, prior)[entries]
    covariance = model.observe(model.units, cross.T)[entries]
    noise = parameters.noise * block.noise_scale[..., t]
    covariance.flat[:: len(entries) + 1] += noise.flat[entries]
    with refuse_singular(parameters):
        whitening, _ = lapack.dtrtri(np.linalg.cholesky(covariance), lower=1)
    # e = z − H x⁻
    data = block.data[..., t].reshape(len(block.data), -1).T[entries]
    residual = data - model.observe(model.units, mean)[entries]
    return entries, whitening, whitening @ residual, whitening @ cross


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
