"""Numbers in text files: how they are read, strictly, and how filled ones are written."""

from __future__ import annotations

from collections.abc import Sequence
from math import nan

import numpy as np

__all__ = ["is_missing", "numeric", "written"]

_MISSING = frozenset({"", "nan", "na", "null"})


def is_missing(cell: str) -> bool:
    """Return whether a cell says that there is no value: empty, NaN, NA or null in any case."""
    return cell.strip().lower() in _MISSING


def numeric(cells: Sequence[str]) -> list[float]:
    """Return the numbers of some cells, NaN for those that are missing.

    Raises
    ------
    ValueError
        If one is neither missing nor a number in plain notation.
    """
    joined = "".join(cells)
    # float() also accepts Python's 1_000 and the digits of other scripts; the formats do not.
    if not joined.isascii() or "_" in joined:
        raise ValueError("digits of another script, or an underscore")
    try:
        return list(map(float, cells))
    except ValueError:  # much slower
        return [nan if is_missing(cell) else float(cell) for cell in cells]


def written(value: float) -> str:
    """Return the shortest decimal number, without an exponent, that reads back the same."""
    return np.format_float_positional(value, trim="0")
