"""Numbers, counts and ids as the page writes them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import count
from urllib.parse import quote

import numpy as np

from mocapbench.basics.words import printable

__all__ = [
    "FEWEST_DECIMALS",
    "MINUS",
    "apart",
    "cell_anchor",
    "decimals",
    "number",
    "plus_minus",
    "slug",
]

MINUS = "\N{MINUS SIGN}"
FEWEST_DECIMALS = 2


def slug(*names: str) -> str:
    """Return an id made of letters, digits and hyphens."""
    characters = "-".join(names).lower()
    return "".join(c if c.isascii() and c.isalnum() else "-" for c in characters)


def cell_anchor(task: str, case: str, label: str) -> str:
    """Return the address on the page of what is known of one cell, without the ``#``."""
    return "cell=" + "/".join(quote(printable(name), safe="") for name in (task, case, label))


def decimals(values: Iterable[float]) -> int:
    """Return how many decimals (2 to 4) show the small ones of ``values`` to two digits.

    One value in ten may be smaller still, so that a single number near zero widens no table.
    """
    sizes = np.abs(np.array([value for value in values if value != 0.0]))
    if not sizes.size:
        return FEWEST_DECIMALS
    return int(np.clip(1 - np.floor(np.log10(np.quantile(sizes, 0.1))), FEWEST_DECIMALS, 4))


def number(value: float, places: int) -> str:
    """Return ``value`` with ``places`` decimals, a true minus sign, and no negative zero."""
    return f"{value:z.{places}f}".replace("-", MINUS)


def apart(first: float, second: float, places: int) -> int:
    """Return the fewest decimals, ``places`` or more, that show two values as different.

    Values that differ by rounding alone need no more than ``places``.
    """
    if math.isclose(first, second):
        return places
    return next(more for more in count(places) if number(first, more) != number(second, more))


def plus_minus(spread: float | None, places: int) -> str:
    """Return the number after ±, empty where there is no spread."""
    return "" if spread is None else number(spread, places)
