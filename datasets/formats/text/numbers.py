"""Numbers in text files: how they are read, strictly, and how filled ones are written."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import nan

import numpy as np

__all__ = ["format_number", "is_missing", "is_number", "looks_numeric", "numeric"]

_MISSING = frozenset(
    [
        *("nan", "na", "n/a", "null", "none", "missing", "-", "--", "---", "?"),
        *("<na>", "nat", "n.a.", "nil", "undefined", ".", "*"),
        *("#n/a", "#num!", "#value!", "#div/0!", "nan(ind)", "nan(snan)"),
        *("#nv", "#zahl!", "#wert!", "#n/d", "#nombre!", "#valeur!"),
        *("1.#ind", "1.#ind00", "1.#qnan", "1.#qnan0", "1.#snan"),
    ]
)
"""Of Excel in some languages, R, Python, SAS, databases, the C library of Microsoft, and people."""
_NUMERIC = re.compile(
    r"""\s*[+\-−]?
    (?=[.,]?\d)
    (\d*|\d{1,3}([.,'’_\s]\d{3})+)  # whole, perhaps with thousands separators
    ([.,]\d*)?
    (e[+\-]?\d+)?\s*""",
    re.IGNORECASE | re.VERBOSE,
)


def is_missing(cell: str) -> bool:
    """Return whether a cell says that there is no value: empty, NaN, NA, null and the like.

    Upper and lower case make no difference, nor does a sign before NaN.
    """
    word = cell.strip().lower()
    return not word or word in _MISSING or (word[0] in "+-" and word[1:] in _MISSING)


def is_number(cell: str, decimal: str) -> bool:
    """Return whether `numeric` takes a cell, and it is not missing."""
    try:
        numeric([cell], decimal)
    except ValueError:
        return False
    return not is_missing(cell)


def looks_numeric(cell: str) -> bool:
    """Return whether people would read a cell as a number, in whatever notation.

    Examples
    --------
    >>> from mocapbench.datasets.formats.text.numbers import looks_numeric
    >>> [looks_numeric(cell) for cell in ("1.5", "1,5", "1.234,5", "1'000")]
    [True, True, True, True]
    >>> [looks_numeric(cell) for cell in ("left", "2024-01-31", "31.01.2024", "v1.2")]
    [False, False, False, False]
    """
    return is_number(cell, ".") or _NUMERIC.fullmatch(cell) is not None


def numeric(cells: Sequence[str], decimal: str = ".") -> list[float]:
    """Return the numbers of some cells, NaN for those that are missing.

    Parameters
    ----------
    cells : sequence of str
    decimal : str
        The decimal mark, a point or a comma.

    Raises
    ------
    ValueError
        If one is neither missing nor a number in plain notation.
    """
    joined = "".join(cells)
    # float() also accepts Python's 1_000 and the digits of other scripts; the formats do not.
    if not joined.isascii() or "_" in joined:
        raise ValueError("digits of another script, or an underscore")
    if decimal != ".":
        if "." in joined:
            raise ValueError("another decimal mark")
        cells = [cell.replace(decimal, ".") for cell in cells]
    try:
        return [float(cell) if cell else nan for cell in cells]
    except ValueError:  # much slower, and gaps are empty cells in most files
        return [nan if is_missing(cell) else float(cell) for cell in cells]


def format_number(value: float, decimal: str = ".") -> str:
    """Return the shortest decimal number, without an exponent, that reads back the same."""
    return np.format_float_positional(value, trim="0").replace(".", decimal)
