"""Arrays by name, the form in which the store keeps solutions and internals of models."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from numpy.typing import NDArray

__all__ = ["Arrays", "arrays_by_number", "select_arrays", "with_numbers", "with_prefix"]

Arrays = Mapping[str, NDArray[Any]]


def with_numbers(name: str, arrays: Iterable[NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Return arrays by the names ``name-0``, ``name-1`` and so on."""
    return {f"{name}-{number}": array for number, array in enumerate(arrays)}


def arrays_by_number(name: str, arrays: Arrays) -> tuple[NDArray[Any], ...]:
    """Return the arrays ``name-0``, ``name-1`` and so on, as many as there are."""
    by_number = with_prefix(name, arrays)
    return tuple(by_number[str(number)] for number in range(len(by_number)))


def with_prefix(prefix: str, arrays: Arrays) -> dict[str, NDArray[Any]]:
    """Return the arrays whose names begin with ``prefix`` and a hyphen, by the rest of the name."""
    start = f"{prefix}-"
    return {n.removeprefix(start): a for n, a in arrays.items() if n.startswith(start)}


def select_arrays(arrays: Arrays, *beginnings: str) -> Arrays:
    """Return the arrays whose names begin with one of ``beginnings``, by their whole names."""
    return {name: array for name, array in arrays.items() if name.startswith(beginnings)}
