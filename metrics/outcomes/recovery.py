"""True and estimated covariances of a process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from types import MappingProxyType
from typing import Any

from mocapbench.metrics.outcomes.arrays import Array, read_only, real_numbers

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
        If covariances are not a mapping of layers to real numbers, or the noise is not a number.
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
        noise: object = self.noise
        if not isinstance(noise, Real):
            raise ValueError(f"expected noise to be a variance, got {noise!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what pickle makes it from: a mapping that is read-only cannot be pickled."""
        return type(self), (dict(self.truth), dict(self.estimate), self.noise)
