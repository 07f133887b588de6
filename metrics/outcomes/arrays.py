"""Arrays of an outcome: numbers, and read-only."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Array", "lock_fields", "lock_numbers", "read_only", "real_numbers"]

Array = NDArray[np.float64]


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """Return a view that cannot be written to; whoever made the array still may."""
    view = np.asarray(array).view()
    view.setflags(write=False)
    return view


def lock_fields(outcome: object, **arrays: NDArray[Any]) -> None:
    """Set fields of a frozen ``outcome`` to arrays, read-only.

    All metrics share an outcome: one that works in place would change what the next one scores.
    """
    for name, array in arrays.items():
        object.__setattr__(outcome, name, read_only(array))


def lock_numbers(outcome: object, *fields: str) -> None:
    """Make these fields of a frozen ``outcome`` arrays of numbers, read-only."""
    kind = type(outcome).__name__
    numbers = {name: real_numbers(f"{name} of {kind}", getattr(outcome, name)) for name in fields}
    lock_fields(outcome, **numbers)


def real_numbers(what: str, values: ArrayLike) -> Array:
    """Return ``values`` as floats, or say that they are text, complex or ragged."""
    try:
        array = np.asarray(values)
        if array.dtype == object and any(isinstance(item, str) for item in array.flat):
            raise TypeError("text among them")
        if array.dtype.kind in "biufO":
            return np.asarray(array, dtype=np.float64)
        got = f"an array of {array.dtype}"
    except (TypeError, ValueError) as error:
        got = f"others: {error}"
    raise ValueError(f"expected {what} to be real numbers, in rows of the same length, got {got}")
