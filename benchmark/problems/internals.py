"""Fitted quantities of a model besides its solution, kept for figures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mocapbench.baselines import Trended
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.latent import space_of, walks_of
from mocapbench.datasets import Frames, Recording

__all__ = ["internals_of"]


def internals_of(model: Any, train: Sequence[Recording]) -> Arrays:
    """Return what a model fitted to ``train`` has.

    Returns
    -------
    mapping of str to ndarray
        The mean and variance (N, D) of a trend, ``trend-mean`` and ``trend-variance``, at the first
        recording's times, ``trend-times`` (N,); the matrices B_q of each layer (Q, D, D), as
        ``coregionalisation-layer``; and what ``space_of`` and ``walks_of`` return.
    """
    arrays: dict[str, Any] = {}
    if "has coregionalisation" in model.provides:
        layers = model.coregionalisation_.items()
        arrays |= {f"coregionalisation-{layer}": matrices for layer, matrices in layers}
    if "has a trend" in model.provides:
        arrays |= _infer_trend(model, train[0].times)
    if "has a latent space" in model.provides:
        arrays |= space_of(model)
    if "has latent dynamics" in model.provides:
        arrays |= walks_of(model)
    return arrays


def _infer_trend(model: Trended, times: Frames) -> Arrays:
    mean, variance = model.trend(times)
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}
