"""Checks of numbers that users give."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mocapbench.basics.arrays import Array

__all__ = ["real_numbers"]


def real_numbers(what: str, values: ArrayLike) -> Array:
    """Return ``values`` as an array of floats, NaN for None.

    Raises
    ------
    ValueError
        If they are complex, text or dates, or rows differ in length; ``what`` names them.
    """
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
