r"""The coordinates of a search, in which the log-likelihood is rounder.

They are the free coordinates of `Parameters` but for two changes. The noise enters by its root,
:math:`\sqrt{\beta_d}` in units of the start's: with :math:`\log\beta` a search would crawl for ever
to where the noise is next to nothing. And a layer's coordinates are scaled by the root of the
number of its draws behind the data, for to that number its Fisher information is proportional.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.parameters import Parameters

__all__ = ["Coordinates"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Coordinates:
    """A one-to-one map between the parameters of a model and vectors.

    Parameters
    ----------
    origin : Parameters
        A point of the space, whose noise is the unit of noise.
    scale : ndarray of shape (n_parameters - D,)
        What the coordinates of the layers are multiplied by.
    """

    origin: Parameters
    scale: Array

    @classmethod
    def around(cls, origin: Parameters, draws: Mapping[str, int]) -> Coordinates:
        """Return coordinates for layers of which so many ``draws`` are behind the data."""
        most = max(draws.values())
        scales = [
            np.full(sum(leaf.size for leaf in layer.leaves), np.sqrt(draws[name] / most))
            for name, layer in origin.layers.items()
        ]
        return cls(origin, np.concatenate(scales))

    def of(self, parameters: Parameters) -> Array:
        """Return the coordinates (n_parameters,) of a point."""
        roots = np.exp(0.5 * (parameters.log_noise - self.origin.log_noise))
        return np.concatenate([self.scale * self._of_layers(parameters.flat), roots])

    def at(self, coordinates: Array) -> Parameters:
        """Return the point with these coordinates: the inverse of `of`."""
        roots = coordinates[len(self.scale) :]
        log_noise = self.origin.log_noise + 2.0 * np.log(roots)
        return self.origin.at(
            np.concatenate([self._of_layers(coordinates) / self.scale, log_noise])
        )

    def pull_back(self, coordinates: Array, gradient: Array) -> Array:
        """Return the gradient in the coordinates of a function with this one in `flat`."""
        roots = coordinates[len(self.scale) :]
        return np.concatenate(
            [self._of_layers(gradient) / self.scale, 2.0 * gradient[len(self.scale) :] / roots]
        )

    def _of_layers(self, vector: Array) -> Array:
        return vector[: len(self.scale)]
