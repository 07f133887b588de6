"""Which models interpolate."""

from __future__ import annotations

from mocapbench.baselines import Interpolator
from mocapbench.benchmark.registry import MODELS

__all__ = ["interpolates"]


def interpolates(model: str) -> bool:
    """Return whether a registered model interpolates; one that is gone does not tell."""
    return model in MODELS.names() and issubclass(MODELS.get(model), Interpolator)
