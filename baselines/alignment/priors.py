r"""The prior of a style's cycle: smooth, and close to its parent.

HLM's exponent is :math:`-\tfrac12\lambda_s\sum_m(z_m - z_{m-1})^2
-\tfrac12\lambda_{\bar z}\sum_m(z_m - \bar z_m)^2` for each channel. There are three priors: with
the normaliser of a Gaussian, with HLM's printed normaliser, and one in which the deviation from the
parent is smooth instead of the cycle.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from scipy.optimize import brentq

from mocapbench.basics.arrays import Array

__all__ = ["PRIORS", "CentredPrior", "CyclePrior", "NormalisedPrior", "PaperPrior"]

_NARROWEST = 1e-12  # least precision, relative to the largest possible optimum


class CyclePrior(ABC):
    """The prior of a cycle."""

    def reference(self, curves: Array) -> Array:
        """Return the curve whose steps the cycle's steps are compared with, given its parent.

        Parameters
        ----------
        curves : ndarray of shape (M, …)
            The parent.
        """
        return np.zeros_like(curves)

    @abstractmethod
    def log_normaliser(self, smoothness: float, closeness: float, n_states: int) -> float:
        """Return the log-normaliser of one cycle in one channel."""

    @abstractmethod
    def smoothness(self, closeness: float, n_states: int, roughness: float) -> float:
        """Return the best λ_s given the mean sum of squared steps, ``roughness``."""

    @abstractmethod
    def closeness(self, smoothness: float, n_states: int, distance: float) -> float:
        """Return the best λ_z̄ given the mean sum of squared distances to the parent."""


class NormalisedPrior(CyclePrior):
    r"""HLM's exponent, normalised by :math:`\tfrac12\log\det(\lambda_s L + \lambda_{\bar z} I)`.

    The Laplacian L of a ring has the eigenvalues :math:`2 - 2\cos(2\pi j/M)`.
    """

    def log_normaliser(self, smoothness: float, closeness: float, n_states: int) -> float:
        """Return ½ log det − ½ M log 2π."""
        spectrum = smoothness * _laplacian(n_states) + closeness
        return float(0.5 * (np.log(spectrum).sum() - n_states * np.log(2.0 * np.pi)))

    def smoothness(self, closeness: float, n_states: int, roughness: float) -> float:
        """Maximise ½ log det − ½ λ_s · roughness."""
        return _best_scale(_laplacian(n_states), np.full(n_states, closeness), roughness)

    def closeness(self, smoothness: float, n_states: int, distance: float) -> float:
        """Maximise ½ log det − ½ λ_z̄ · distance."""
        return _best_scale(np.ones(n_states), smoothness * _laplacian(n_states), distance)


class CentredPrior(NormalisedPrior):
    r"""A Gaussian about the parent: the steps are those of :math:`z - \bar z` instead of z.

    A cycle is its parent plus a smooth deviation. Under HLM's prior a cycle is drawn towards a
    constant: its prior mean is a smoothed parent, and a part of the cycle without visible frames
    becomes nearly straight.
    """

    def reference(self, curves: Array) -> Array:
        """Return the parent itself."""
        return curves


class PaperPrior(CyclePrior):
    """HLM eq. (5): each of the 2M factors is normalised, although their product is not."""

    def log_normaliser(self, smoothness: float, closeness: float, n_states: int) -> float:
        """Return ½ M log(λ_s λ_z̄) − M log 2π."""
        return float(
            n_states * (0.5 * np.log(smoothness) + 0.5 * np.log(closeness) - np.log(2.0 * np.pi))
        )

    def smoothness(self, closeness: float, n_states: int, roughness: float) -> float:
        """Return HLM eq. (13)."""
        del closeness  # it occurs in a different factor
        return n_states / roughness

    def closeness(self, smoothness: float, n_states: int, distance: float) -> float:
        """Return HLM eq. (12)."""
        del smoothness  # it occurs in a different factor
        return n_states / distance


PRIORS: dict[str, CyclePrior] = {
    "normalised": NormalisedPrior(),
    "centred": CentredPrior(),
    "paper": PaperPrior(),
}


def _laplacian(n_states: int) -> Array:
    """Return the eigenvalues of the Laplacian of a ring."""
    return np.asarray(2.0 - 2.0 * np.cos(2.0 * np.pi * np.arange(n_states) / n_states))


def _best_scale(slope: Array, offset: Array, quadratic: float) -> float:
    """Return the λ > 0 that maximises Σ log(λ slope + offset) − λ quadratic, which is concave."""

    def gradient(scale: float) -> float:
        return float((slope / (scale * slope + offset)).sum() - quadratic)

    largest = np.count_nonzero(slope) / quadratic
    least = _NARROWEST * largest
    if gradient(least) <= 0:
        return float(least)
    return float(brentq(gradient, least, largest, rtol=1e-13))
