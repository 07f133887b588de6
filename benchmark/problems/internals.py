"""Fitted quantities of a model besides its solution, kept for figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays, select_arrays, with_prefix
from mocapbench.benchmark.problems.latent import space_of, walks_of
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["Internals", "Trend", "internals_of"]


@dataclass(frozen=True, eq=False)
class Trend:
    """The trend that a model infers: mean and variance (N, D) at times (N,)."""

    times: Frames
    mean: FrameByChannel
    variance: FrameByChannel

    def to_arrays(self) -> Arrays:
        """Return ``trend-times``, ``trend-mean`` and ``trend-variance``."""
        return {f"trend-{name}": array for name, array in vars(self).items()}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self | None:
        """Return the trend that `to_arrays` turned into ``arrays``, None if there is none."""
        own = with_prefix("trend", arrays)
        return cls(**own) if own else None


@dataclass(frozen=True, eq=False)
class Internals:
    """The fitted quantities that a model has, by kind.

    Parameters
    ----------
    trend : Trend or None
    coregionalisation : mapping of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer; empty for a model without them.
    latent_space, latent_walks : mapping of str to ndarray, or None
        See ``space_of`` and ``walks_of``.
    """

    trend: Trend | None = None
    coregionalisation: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    latent_space: Arrays | None = None
    latent_walks: Arrays | None = None

    def to_arrays(self) -> Arrays:
        """Return the arrays of all of them, by name."""
        arrays: dict[str, NDArray[Any]] = {
            f"coregionalisation-{layer}": matrices
            for layer, matrices in self.coregionalisation.items()
        }
        trend = self.trend.to_arrays() if self.trend is not None else {}
        return {**arrays, **trend, **(self.latent_space or {}), **(self.latent_walks or {})}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self:
        """Return the quantities that `to_arrays` turned into ``arrays``; ignore other names."""
        return cls(
            Trend.from_arrays(arrays),
            with_prefix("coregionalisation", arrays),
            select_arrays(arrays, "property-", "latent-path-", "latent-cloud") or None,
            select_arrays(arrays, "latent-mean", "latent-sample-", "walk-") or None,
        )


def internals_of(model: Any, train: Sequence[Recording]) -> Internals:
    """Return what a model fitted to ``train`` has; the trend at the first recording's times."""
    times = train[0].times
    return Internals(
        Trend(times, *model.trend(times)) if "has a trend" in model.provides else None,
        model.coregionalisation_ if "has coregionalisation" in model.provides else {},
        space_of(model) if "has a latent space" in model.provides else None,
        walks_of(model) if "has latent dynamics" in model.provides else None,
    )
