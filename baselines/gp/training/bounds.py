"""Bounds of the parameters in a search, for outputs in standard units."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.coregionalisation import Coregionalisation
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.basics.arrays import Array

__all__ = ["bounds"]


MIN_NOISE, MAX_NOISE = 1e-6, 10.0
MAX_LOADING = 30.0
"""Bound of |W| and √κ in standard deviations of the output: wider than any fit needs, and far from
overflow."""


def bounds(parameters: Parameters, times: Array) -> tuple[Parameters, Parameters]:
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
            Coregionalisation(
                np.full_like(layer.coregionalisation.weights, loading),
                np.full_like(layer.coregionalisation.kappa_roots, loading),
            ),
        )
        for name, layer in parameters.layers.items()
    }
    return Parameters(layers, np.full_like(parameters.log_noise, log_noise))
