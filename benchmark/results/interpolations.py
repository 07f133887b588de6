"""Which models interpolate."""

from __future__ import annotations

from mocapbench.benchmark.registry import MODELS, build_unfitted

__all__ = ["interpolates"]


def interpolates(model: str) -> bool:
    """Return whether a registered model interpolates; one that is gone does not tell."""
    return model in MODELS.names() and "interpolates" in build_unfitted(model).provides
