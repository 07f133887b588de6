r"""The prior of a style's cycle: smooth, and close to its parent.

HLM's exponent is :math:`-\tfrac12\lambda_s\sum_m(z_m - z_{m-1})^2
-\tfrac12\lambda_{\bar z}\sum_m(z_m - \bar z_m)^2` per channel; what makes it a density in the two
precisions is stated in two ways, and in a third one it is the deviation from the parent that is
smooth.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from scipy.optimize import brentq

from mocapbench.baselines.alignment.sequences import Array

__all__ = ["PRIORS", "CentredPrior", "CyclePrior", "NormalisedPrior", "PaperPrior"]

_NARROWEST = 1e-12  # least precision, in parts of the largest that can be best


class CyclePrior(ABC):
    """How the prior of a cycle is normalised."""

    def reference(self, curves: Array) -> Array:
        """Return what a cycle's steps are compared with where its parent is ``curves`` (M, …)."""
        return np.zeros_like(curves)

    @abstractmethod
    def log_normaliser(self, smoothness: float, closeness: float, n_states: int) -> float:
        """Return the logarithm of the factor of the exponential, per cycle and channel."""

    @abstractmethod
    def smoothness(self, closeness: float, n_states: int, roughness: float) -> float:
        """Return the best smoothness for a mean of the sum of squared steps."""

    @abstractmethod
    def closeness(self, smoothness: float, n_states: int, distance: float) -> float:
        """Return the best closeness for a mean of the sum of squared distances to the parent."""


class NormalisedPrior(CyclePrior):
    r"""The Gaussian's own normaliser, :math:`\tfrac12\log\det(\lambda_s L + \lambda_{\bar z} I)`.

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
    r"""A Gaussian about the parent: its exponent has :math:`z - \bar z` in place of z in the steps.

    A cycle is then its parent but for a smooth deviation. HLM's own steps draw it to a constant:
    its mean is the parent made smoother, and the part of a cycle that nothing shows is nearly
    straight.
    """

    def reference(self, curves: Array) -> Array:
        """Return the parent itself."""
        return curves


class PaperPrior(CyclePrior):
    """HLM eq. (5): each of the 2M factors normalised for itself, although their product is not."""

    def log_normaliser(self, smoothness: float, closeness: float, n_states: int) -> float:
        """Return ½ M log(λ_s λ_z̄) − M log 2π."""
        return float(
            n_states * (0.5 * np.log(smoothness) + 0.5 * np.log(closeness) - np.log(2.0 * np.pi))
        )

    def smoothness(self, closeness: float, n_states: int, roughness: float) -> float:
        """HLM eq. (13)."""
        del closeness  # in its own factor alone
        return n_states / roughness

    def closeness(self, smoothness: float, n_states: int, distance: float) -> float:
        """HLM eq. (12)."""
        del smoothness  # in its own factor alone
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
    """Maximise Σ log(λ slope + offset) − λ quadratic, which is concave, over λ > 0."""

    def gradient(scale: float) -> float:
        return float((slope / (scale * slope + offset)).sum() - quadratic)

    largest = np.count_nonzero(slope) / quadratic
    least = _NARROWEST * largest
    if gradient(least) <= 0:
        return float(least)
    return float(brentq(gradient, least, largest, rtol=1e-13))
