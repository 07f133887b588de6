"""Fitted quantities of a model besides its solution, kept for figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Trended
from mocapbench.benchmark.problems.arrays import Arrays, select_arrays, with_prefix
from mocapbench.benchmark.problems.latent import space_of, walks_of
from mocapbench.datasets import Frames, Recording

__all__ = ["Internals", "internals_of"]


@dataclass(frozen=True, eq=False)
class Internals:
    """The fitted quantities that a model has, by kind.

    Parameters
    ----------
    trend : mapping of str to ndarray, or None
        The ``trend-mean`` and ``trend-variance`` (N, D) at ``trend-times`` (N,).
    coregionalisation : mapping of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer; empty for a model without them.
    latent_space, latent_walks : mapping of str to ndarray, or None
        See ``space_of`` and ``walks_of``.
    """

    trend: Arrays | None = None
    coregionalisation: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    latent_space: Arrays | None = None
    latent_walks: Arrays | None = None

    def to_arrays(self) -> Arrays:
        """Return the arrays of all of them, by name."""
        arrays: dict[str, NDArray[Any]] = {
            f"coregionalisation-{layer}": matrices
            for layer, matrices in self.coregionalisation.items()
        }
        space, walks = self.latent_space or {}, self.latent_walks or {}
        return {**arrays, **(self.trend or {}), **space, **walks}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self:
        """Return the quantities that `to_arrays` turned into ``arrays``; ignore other names."""
        return cls(
            select_arrays(arrays, "trend-") or None,
            with_prefix("coregionalisation", arrays),
            select_arrays(arrays, "property-", "latent-path-", "latent-cloud") or None,
            select_arrays(arrays, "latent-mean", "latent-sample-", "walk-") or None,
        )


def internals_of(model: Any, train: Sequence[Recording]) -> Internals:
    """Return what a model fitted to ``train`` has; the trend at the first recording's times."""
    return Internals(
        _infer_trend(model, train[0].times) if "has a trend" in model.provides else None,
        model.coregionalisation_ if "has coregionalisation" in model.provides else {},
        space_of(model) if "has a latent space" in model.provides else None,
        walks_of(model) if "has latent dynamics" in model.provides else None,
    )


def _infer_trend(model: Trended, times: Frames) -> Arrays:
    mean, variance = model.trend(times)
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}
