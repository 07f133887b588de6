"""Arrays of an outcome: numbers, and read-only."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.numbers import real_numbers

__all__ = ["lock_fields", "lock_numbers", "read_only"]


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
