r"""Processes over frames whose parameters best predict stretches that are held out.

The likelihood of frames in a row says how well each is told from the one before, which is not what
is wanted of a gap. Here every frame belongs to one of several stretches, and each stretch in turn
is predicted from all the others.

With the covariance K (n, n) of the frames, noise included, its inverse P, values Z (n, O) and
:math:`A = P Z`, frames i of a stretch g that is held out have the errors
:math:`r_g = P_{gg}^{-1} A_g` and the covariance :math:`P_{gg}^{-1}` (C. E. Rasmussen and C. K. I.
Williams (2006), Gaussian Processes for Machine Learning, MIT Press, §5.4.2, with stretches in place
of points). With its diagonal s and one unknown scale, which is
:math:`\hat\sigma^2 = \operatorname{mean} r_{io}^2 / s_i`, the negative logarithm of the predictive
densities of all frames, each by itself, is

.. math::

    \tfrac12 n O \log \hat\sigma^2 + \tfrac12 O \sum_i \log s_i + \text{constant}.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.blas import dtrsm
from scipy.optimize import Bounds, minimize

from mocapbench.baselines.common.cholesky import decompose, invert
from mocapbench.basics.arrays import Array, Index

__all__ = [
    "HeldOutStretches",
    "Pairs",
    "add_noise",
    "learn_parameters",
    "noise_variance",
    "predict_frames",
    "stretch_numbers",
]


_WIDTH = 4.0
"""Most deviations of a logarithm from its prior median."""
_STEPS = 15
"""Of the search: more change predictions little."""
_FEWEST_STRETCHES = 4
"""Stretches that are held out are shorter than the gap to fill where there would be fewer."""
_JITTER = 1e-6
_TINY = float(np.finfo(np.float64).tiny)


class Pairs(Protocol):
    """How n frames are related to m others, in the eyes of a process with P parameters."""

    def covariance(self, parameters: Array) -> Array:
        """Return the covariance (n, m), noise left out; parameters (P,) are logarithms.

        The last of them is that of the standard deviation of the noise.
        """
        ...

    def derivatives(self, parameters: Array) -> Sequence[Array]:
        """Return those of the covariance by the parameters, the last of them left out."""
        ...


@dataclass(frozen=True, eq=False)
class HeldOutStretches:
    """What a process makes of each stretch of frames, given all the others.

    Parameters
    ----------
    covariance : ndarray of shape (n, n)
        K, positive definite, up to scale.
    values : ndarray of shape (n, O)
        Z, with mean zero.
    stretch : ndarray of int, shape (n,)
        The number of each frame's stretch.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the covariance is not numerically positive definite.
    """

    covariance: Array
    values: Array
    stretch: NDArray[np.intp]

    @cached_property
    def errors(self) -> Array:
        """(n, O) the values less their predictions."""
        return self._within @ self._dual

    @cached_property
    def variances(self) -> Array:
        """(n,) the variance of each prediction, up to scale."""
        return np.diagonal(self._within)

    @cached_property
    def scale(self) -> float:
        """The mean ratio of squared errors to variances; positive even where nothing errs."""
        return max(float(self.scales.mean()), _TINY)

    @property
    def scales(self) -> Array:
        """(O,) the mean ratio of squared errors to variances of each output."""
        return np.asarray((self.errors**2 / self.variances[:, None]).mean(axis=0))

    @property
    def score(self) -> float:
        """The negative log-density of held-out frames, each by itself; the less, the better."""
        n_frames, n_outputs = self.values.shape
        logarithms = n_frames * np.log(self.scale) + np.log(self.variances).sum()
        return float(0.5 * n_outputs * logarithms)

    @cached_property
    def sensitivity(self) -> Array:
        r"""(n, n) the derivatives of the `score` by the entries of the covariance.

        With :math:`\mathrm dP = -P\, \mathrm dK\, P`, stretches' inverses in the blocks of B,
        :math:`u_{io} = r_{io} / (\hat\sigma^2 s_i)` and
        :math:`h_i = \tfrac12 \sum_o (1 / s_i - r_{io}^2 / (\hat\sigma^2 s_i^2))`, it is the
        symmetric part of

        .. math:: P\,\bigl[(B u) r^\top + B \operatorname{diag}(h) B\bigr]_{\text{blocks}}\, P
            - P\, B u\, A^\top .
        """
        # u and h, which are derivatives of the score by r and by s.
        variances = self.variances[:, None]
        relative = self.errors / (self.scale * variances)
        by_variance = 0.5 * (1.0 / variances - relative * self.errors / variances).sum(axis=1)
        # (B u) rᵀ + B diag(h) B in blocks.
        outward = self._within @ relative
        blocks = np.where(self._together, outward @ self.errors.T, 0.0)
        blocks += (self._within * by_variance) @ self._within
        # P [·] P − P (B u) Aᵀ, and its symmetric part.
        precision = self._precision
        one_way = precision @ (blocks @ precision - outward @ self._dual.T)
        return np.asarray(0.5 * (one_way + one_way.T))

    @cached_property
    def _precision(self) -> Array:
        precision = np.array(self.covariance, order="C")
        invert(precision)
        return precision

    @cached_property
    def _dual(self) -> Array:
        return np.asarray(self._precision @ self.values)

    @cached_property
    def _together(self) -> NDArray[np.bool_]:
        return np.asarray(np.equal.outer(self.stretch, self.stretch))

    @cached_property
    def _within(self) -> Array:
        """(n, n) the covariance of each stretch given the others, in blocks; 0 elsewhere."""
        blocks = np.zeros_like(self._precision)
        for frames in _group_by_length(self.stretch):
            place = frames[:, :, None], frames[:, None, :]
            blocks[place] = np.linalg.inv(self._precision[place])
        return blocks


def _group_by_length(stretch: Index) -> list[Index]:
    """Return the frames (G, L) of all stretches of each length L, which are inverted together."""
    frames = np.argsort(stretch, kind="stable")
    lengths = np.unique(stretch, return_counts=True)[1]
    starts = np.cumsum(lengths) - lengths
    return [
        frames[starts[lengths == length][:, None] + np.arange(length)]
        for length in np.unique(lengths)
    ]


def learn_parameters(
    pairs: Pairs, values: Array, stretch: Index, typical: Array, weight: float
) -> Array:
    r"""Return the parameters (P,) with which each stretch of frames is predicted best.

    They have the least negative log-density of what is held out (`HeldOutStretches`) times the
    weight, and of normal priors of logarithms, with standard deviation 1.

    Parameters
    ----------
    pairs : Pairs
        Of n frames with themselves.
    values : ndarray of shape (n, O)
        With a mean square of 1.
    stretch : ndarray of int, shape (n,)
        The number of each frame's stretch.
    typical : ndarray of shape (P,)
        The medians of the priors.
    weight : float
        What the density of one value counts.
    """

    def objective(parameters: Array) -> tuple[float, Array]:
        held_out = HeldOutStretches(add_noise(pairs, parameters), values, stretch)
        # ⟨∂score / ∂K, ∂K⟩ of each parameter; K has ε² on its diagonal.
        by = [np.vdot(held_out.sensitivity, each) for each in pairs.derivatives(parameters)]
        by.append(2.0 * np.exp(2.0 * parameters[-1]) * np.trace(held_out.sensitivity))
        deviations = parameters - typical
        score = weight * held_out.score + 0.5 * float(deviations @ deviations)
        return score, weight * np.array(by) + deviations

    found = minimize(
        objective,
        typical,
        jac=True,
        method="L-BFGS-B",
        bounds=Bounds(typical - _WIDTH, typical + _WIDTH),
        options={"maxiter": _STEPS},
    )
    return np.asarray(found.x)


def predict_frames(covariance: Array, cross: Array, values: Array) -> tuple[Array, Array]:
    r"""Return the mean in m frames given n others, and by how much that lessens their variances.

    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press, eq. (2.25) and (2.26), of which Algorithm 2.1 is followed: with :math:`K = L L^\top`,
    what is solved by L alone is enough for both.

    Parameters
    ----------
    covariance : ndarray of shape (n, n)
        Of the n frames, noise included; C-ordered, and overwritten. Its upper triangle is not read.
    cross : ndarray of shape (m, n)
        The covariance of the m frames with the n.
    values : ndarray of shape (n, O)

    Returns
    -------
    mean : ndarray of shape (m, O)
    explained : ndarray of shape (m,)
    """
    decompose(covariance)
    # BLAS sees the upper triangle Lᵀ in Fortran's order: L⁻¹ of both sides at once.
    sides = np.concatenate([cross, values.T]).T
    solved = dtrsm(1.0, covariance.T, sides, trans_a=1, overwrite_b=1)
    gain, weighted = np.split(solved, [len(cross)], axis=1)
    return gain.T @ weighted, (gain**2).sum(axis=0)


def add_noise(pairs: Pairs, parameters: Array) -> Array:
    """Return the covariance (n, n) of frames with themselves, noise included."""
    covariance = pairs.covariance(parameters)
    covariance[np.diag_indices_from(covariance)] += noise_variance(parameters)
    return covariance


def noise_variance(parameters: Array) -> float:
    """Return what noise adds to the variance of a frame, with what makes factors exist."""
    return float(np.exp(2.0 * parameters[-1])) + _JITTER


def stretch_numbers(
    times: NDArray[np.float64 | np.intp], recording: Index, duration: float
) -> Index:
    """Return the numbers (n,) of stretches that last so long, or less if they would be few.

    Parameters
    ----------
    times : ndarray of shape (n,)
    recording : ndarray of int, shape (n,)
        The number of each frame's recording.
    duration : float
        In the unit of times.
    """
    numbers, each = np.unique(recording, return_inverse=True)
    first = np.array([times[recording == number].min() for number in numbers])
    since = times - first[each]
    total = sum(since[recording == number].max() for number in numbers)
    number = since // max(min(duration, total / _FEWEST_STRETCHES), np.finfo(np.float64).tiny)
    _, stretch = np.unique(np.column_stack([recording, number]), axis=0, return_inverse=True)
    return np.asarray(stretch.ravel())
