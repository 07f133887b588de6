"""A fit: what an entrant answered to a problem, and what it cost."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from mocapbench.benchmark.problems.arrays import Arrays

__all__ = ["Fit"]


@dataclass(frozen=True)
class Fit:
    """Everything that scoring again and drawing figures needs.

    Parameters
    ----------
    arrays : mapping of str to ndarray
        The solution and the model's internals, as they turn themselves into arrays.
    fit_seconds, predict_seconds, peak_memory_mb : float
    iterations, converged : int or None, bool or None
        Of the optimisation, where the model has one.
    engine : str
        The algorithm that the model computed with and why, where it says so.
    warnings : tuple of str
        Warnings that the model raised.
    """

    arrays: Arrays
    fit_seconds: float
    predict_seconds: float
    peak_memory_mb: float
    iterations: int | None
    converged: bool | None
    engine: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def costs(self) -> dict[str, Any]:
        """All but the arrays, by name."""
        names = (field.name for field in fields(self) if field.name != "arrays")
        return {name: getattr(self, name) for name in names}
