r"""The coordinates of a search, in which the log-likelihood is better conditioned.

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

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.basics.arrays import Array

__all__ = ["Coordinates"]


@dataclass(frozen=True, eq=False)
class Coordinates:
    """A one-to-one map between the parameters of a model and vectors.

    Parameters
    ----------
    origin : Parameters
        Parameters of the same shapes, whose noise is the unit of noise.
    scale : ndarray of shape (n_parameters - D,)
        Factors of the layers' coordinates.
    """

    origin: Parameters
    scale: Array

    @classmethod
    def around(cls, origin: Parameters, draws: Mapping[str, int]) -> Coordinates:
        """Return coordinates, given for each layer the number of its ``draws`` in the data."""
        most = max(draws.values())
        scales = [
            np.full(sum(leaf.size for leaf in layer.leaves), np.sqrt(draws[name] / most))
            for name, layer in origin.layers.items()
        ]
        return cls(origin, np.concatenate(scales))

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
        roots = coordinates[len(self.scale) :]
        return np.concatenate(
            [self._of_layers(gradient) / self.scale, 2.0 * gradient[len(self.scale) :] / roots]
        )

    def _of_layers(self, vector: Array) -> Array:
        return vector[: len(self.scale)]
