r"""Forward in time: the Kalman filter.

At frame t the state is predicted, :math:`x^- = \Phi x`, :math:`P^- = \Phi P \Phi^\top + Q`, and
corrected by the visible entries, whose innovations are independent of everything before:

.. math:: e = z - H x^-, \quad S = H P^- H^\top + R = L L^\top, \quad A = L^{-1} H P^-, \quad
          x = x^- + A^\top L^{-1} e, \quad P = P^- - A^\top A.

Hence :math:`\log|K| = \sum_t \log|S_t|` and :math:`z^\top K^{-1} z = \sum_t |L_t^{-1} e_t|^2`, a
sum of squares. The covariances are common to all data vectors.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from mocapbench.baselines.gp.prior.kernels import Kernel
from mocapbench.baselines.gp.prior.markov import Steps
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.solvers.state_space.model import StateModel

__all__ = ["Belief", "Filtered", "Innovation"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Belief:
    """What is known of the state: x (s, h), a column for each data vector, and P (s, s)."""

    mean: Array
    covariance: Array

    def carried(self, model: StateModel, transition: Array, noise: Array) -> Belief:
        """Return Φ x and Φ P Φᵀ + Q ⊗ B; ``transition`` and ``noise`` are (J, m, m)."""
        return Belief(
            model.propagate(transition, self.mean),
            model.spread(transition, noise, self.covariance),
        )

    def corrected(self, innovation: Innovation) -> Belief:
        """Return x + Aᵀ L⁻¹ e and P − Aᵀ A."""
        explained = innovation.explained
        return Belief(
            self.mean + explained.T @ innovation.white,
            self.covariance - explained.T @ explained,
        )


@dataclass(frozen=True, eq=False)
class Innovation:
    """What the V visible entries of a frame add.

    Parameters
    ----------
    entries : ndarray of shape (V,)
        Their indices among the frame's P D entries.
    whitening : ndarray of shape (V, V)
        L⁻¹.
    white : ndarray of shape (V, h)
        L⁻¹ e.
    explained : ndarray of shape (V, s)
        A.
    """

    entries: NDArray[np.intp]
    whitening: Array
    white: Array
    explained: Array


@dataclass(frozen=True, eq=False)
class Filtered:
    """A block's filter.

    Parameters
    ----------
    model : StateModel
        The block as chains in time.
    block : Block
        The problem, without frames that show nothing.
    parameters : Parameters
        Where it is evaluated.
    steps : Steps
        The steps into each of the N frames, the first from nowhere.
    beliefs : list of Belief
        N + 1 of them: after no frame, after the first, …, after the last.
    innovations : list of Innovation
        Those of the N frames.
    """

    model: StateModel
    block: Block
    parameters: Parameters
    steps: Steps
    beliefs: list[Belief]
    innovations: list[Innovation]

    @classmethod
    def of(cls, kernel: Kernel, block: Block, parameters: Parameters) -> Filtered:
        """Pass through ``block`` at ``parameters``."""
        block = block.trimmed()
        model = StateModel.of(kernel, block, parameters)
        steps = model.steps(np.diff(block.times, prepend=-np.inf))
        size, n_vectors = model.size, len(block.data)
        beliefs, innovations = [Belief(np.zeros((size, n_vectors)), np.zeros((size, size)))], []
        for t, (transition, noise) in enumerate(zip(steps.transition, steps.noise, strict=True)):
            predicted = beliefs[-1].carried(model, transition, noise)
            innovations.append(_innovation(model, block, parameters, predicted, t))
            beliefs.append(predicted.corrected(innovations[-1]))
        return cls(model, block, parameters, steps, beliefs, innovations)

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        log_roots = sum(np.log(np.diagonal(each.whitening)).sum() for each in self.innovations)
        squares = sum(np.vdot(each.white, each.white) for each in self.innovations)
        log_scale = self.block.n_visible * np.log(2.0 * np.pi) - 2.0 * log_roots
        return float(-0.5 * (self.block.multiplicity * log_scale + squares))


def _innovation(
    model: StateModel, block: Block, parameters: Parameters, predicted: Belief, t: int
) -> Innovation:
    entries = np.flatnonzero(block.observed[..., t])
    cross = model.read(model.units, predicted.covariance)[entries]
    covariance = model.read(model.units, cross.T)[entries]
    noise = parameters.noise * block.noise_scale[..., t]
    covariance.flat[:: len(entries) + 1] += noise.flat[entries]
    try:
        whitening, _ = lapack.dtrtri(np.linalg.cholesky(covariance), lower=1)
    except np.linalg.LinAlgError:
        raise SingularCovarianceError(parameters) from None
    data = block.data[..., t].reshape(len(block.data), -1).T[entries]
    residual = data - model.read(model.units, predicted.mean)[entries]
    return Innovation(entries, whitening, whitening @ residual, whitening @ cross)
