"""What a fitted model tells of itself besides its answer: kept with it, for figures."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.baselines import Coregionalised, Model, Trended
from mocapbench.benchmark.problem import Solution
from mocapbench.datasets import Recording

__all__ = ["disclosed"]


def disclosed(model: Model, train: Sequence[Recording]) -> Solution:
    """Return what a model fitted to ``train`` is able to tell, as arrays by name.

    ``trend-times`` (N,), those of the first recording, with ``trend-mean`` and ``trend-variance``
    (N, D); ``coregionalisation-parent``, ``coregionalisation-child`` … (Q, D, D), by layer.
    """
    return {**_trend(model, train), **_coregionalisation(model)}


def _trend(model: Model, train: Sequence[Recording]) -> Solution:
    if not isinstance(model, Trended):
        return {}
    times = train[0].times
    mean, variance = model.trend(times)
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}


def _coregionalisation(model: Model) -> Solution:
    if not isinstance(model, Coregionalised):
        return {}
    matrices = model.coregionalisation_.items()
    return {f"coregionalisation-{layer}": of_layer for layer, of_layer in matrices}
