"""True and estimated covariances of a process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from types import MappingProxyType
from typing import Any

from mocapbench.basics.arrays import Array
from mocapbench.basics.numbers import real_numbers
from mocapbench.metrics.outcomes.arrays import read_only

__all__ = ["Recovery"]


@dataclass(frozen=True, eq=False)
class Recovery:
    """True and estimated covariances of the layers of a process.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : mapping of str to ndarray of shape (n, n)
        Covariance of the curves of each layer, ``"parent"`` and ``"child"``, without noise.
    estimate : mapping of str to ndarray of shape (n, n)
        Estimated covariances, of the layers that the model has.
    noise : float
        Variance of the noise in which the curves were observed.

    Raises
    ------
    ValueError
        If covariances are not a mapping of layers to real numbers, an estimated layer has no true
        covariance or one that is not square and of the same size, or the noise is not a number.
    """

    truth: Mapping[str, Array]
    estimate: Mapping[str, Array]
    noise: float

    def __post_init__(self) -> None:
        for name in ("truth", "estimate"):
            layers = getattr(self, name)
            if not isinstance(layers, Mapping):
                raise ValueError(
                    f"expected {name} to be a mapping of layers to covariances, got {layers!r}"
                )
            matrices = {
                layer: read_only(real_numbers(f"{name} of layer {layer!r}", matrix))
                for layer, matrix in layers.items()
            }
            object.__setattr__(self, name, MappingProxyType(matrices))
        self._check_layers()
        noise: object = self.noise
        if not isinstance(noise, Real):
            raise ValueError(f"expected noise to be a variance, got {noise!r}")

    def _check_layers(self) -> None:
        for layer, estimate in self.estimate.items():
            if layer not in self.truth:
                raise ValueError(
                    f"expected a covariance of layer {layer!r} among the true ones, "
                    f"got those of {sorted(self.truth)}"
                )
            truth = self.truth[layer]
            if truth.ndim != 2 or truth.shape != truth.T.shape or truth.shape != estimate.shape:
                raise ValueError(
                    f"expected two square matrices of the same size for layer {layer!r}, "
                    f"got shapes {truth.shape} and {estimate.shape}"
                )

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what pickle makes it from: a mapping that is read-only cannot be pickled."""
        return type(self), (dict(self.truth), dict(self.estimate), self.noise)
