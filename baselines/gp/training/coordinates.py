r"""The coordinates of a search, in which it is better conditioned, and their bounds.

They are the free coordinates of `Parameters` with two changes (docs/mathematics/prediction.md,
section 10). The noise enters by its root, :math:`\sqrt{\beta_d}` relative to the start's, because
with :math:`\log\beta` a search approaches very small noise ever more slowly. And a layer's
coordinates are scaled by the root of the number of its draws in the data, since its Fisher
information is proportional to that number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds

from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.basics.arrays import Array

__all__ = ["MAX_LOADING", "MAX_NOISE", "MIN_NOISE", "Coordinates", "parameter_bounds"]


MIN_NOISE, MAX_NOISE = 1e-6, 10.0
MAX_LOADING = 30.0
"""Bound of |W| and √κ in standard deviations of the output: wider than any fit needs, and far from
overflow."""


@dataclass(frozen=True, eq=False)
class Coordinates:
    """A one-to-one map between the parameters of a model and vectors, within bounds.

    Parameters
    ----------
    origin : Parameters
        Parameters of the same shapes, whose noise is the unit of noise.
    scale : ndarray of shape (n_parameters - D,)
        Factors of the layers' coordinates.
    lower, upper : Parameters
        Bounds of the parameters, for outputs in standard units.
    """

    origin: Parameters
    scale: Array
    lower: Parameters
    upper: Parameters

    @classmethod
    def around(cls, origin: Parameters, draws: Mapping[str, int], times: Array) -> Coordinates:
        """Return coordinates, given for each layer the number of its ``draws`` in the data.

        A lengthscale lies between half the shortest step and ten times the span of ``times`` (N,).
        """
        # The square root of a layer's Fisher information, relative to that of the most draws.
        most = max(draws.values())
        scales = [
            np.full(sum(leaf.size for leaf in layer.leaves), np.sqrt(draws[name] / most))
            for name, layer in origin.layers.items()
        ]
        return cls(origin, np.concatenate(scales), *parameter_bounds(origin, times))

    @property
    def bounds(self) -> Bounds:
        """The bounds of the coordinates."""
        return Bounds(self.of(self.lower), self.of(self.upper))

    def of(self, parameters: Parameters) -> Array:
        """Return the coordinates (n_parameters,) of parameters."""
        roots = np.exp(0.5 * (parameters.log_noise - self.origin.log_noise))
        return np.concatenate([self.scale * self._of_layers(parameters.flat), roots])

    def at(self, coordinates: Array) -> Parameters:
        """Return the parameters with these coordinates: the inverse of `of`."""
        roots = coordinates[len(self.scale) :]
        log_noise = self.origin.log_noise + 2.0 * np.log(roots)
        return self.origin.at(
            np.concatenate([self._of_layers(coordinates) / self.scale, log_noise])
        )

    def pull_back(self, coordinates: Array, gradient: Array) -> Array:
        """Return the gradient in the coordinates of a function, given that in `Parameters.flat`."""
        # ∂ log β / ∂ root = 2 / root.
        roots = coordinates[len(self.scale) :]
        return np.concatenate(
            [self._of_layers(gradient) / self.scale, 2.0 * gradient[len(self.scale) :] / roots]
        )

    def _of_layers(self, vector: Array) -> Array:
        return vector[: len(self.scale)]


def parameter_bounds(parameters: Parameters, times: Array) -> tuple[Parameters, Parameters]:
    """Return the lower and upper bounds of parameters with the shapes of the given ones.

    A lengthscale lies between half the shortest step and ten times the span of ``times`` (N,).
    """
    steps = np.diff(times) if len(times) > 1 else np.ones(1)
    shortest, longest = np.log(0.5 * steps.min()), np.log(10.0 * steps.sum())
    return (
        _constant(parameters, shortest, -MAX_LOADING, np.log(MIN_NOISE)),
        _constant(parameters, longest, MAX_LOADING, np.log(MAX_NOISE)),
    )


def _constant(
    parameters: Parameters, log_lengthscale: float, loading: float, log_noise: float
) -> Parameters:
    """Return parameters of the same shapes with one value for all coordinates of a kind."""
    layers = {
        name: LayerParameters(
            np.full_like(layer.log_lengthscales, log_lengthscale),
            np.full_like(layer.weights, loading),
            np.full_like(layer.kappa_roots, loading),
        )
        for name, layer in parameters.layers.items()
    }
    return Parameters(layers, np.full_like(parameters.log_noise, log_noise))
