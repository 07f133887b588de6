"""Remarks on the papers' numbers, as data: errata, and reasons why numbers are not comparable.

``errata.csv`` and ``not_comparable.csv`` hold one remark a row. Each of ``source``, ``case``,
``metric`` and ``model`` is a pattern, where ``*`` stands for anything and ``[47]`` for 4 or 7.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fnmatch import fnmatchcase
from io import StringIO
from string import ascii_lowercase

import pandas as pd

__all__ = ["PublishedAddress", "Remarks", "footnotes", "marks", "parse_remarks", "remark_on"]

COLUMNS = ["source", "case", "metric", "model", "note"]

PublishedAddress = tuple[str, str, str, str]
"""Source, case, metric and model of a number, in the paper's names."""


Remarks = Mapping[PublishedAddress, str]
"""A note by the patterns of the addresses that it concerns."""


def parse_remarks(text: str) -> Remarks:
    """Return the rows of a CSV table of remarks.

    Raises
    ------
    ValueError
        If the header is another, or a field is empty.
    """
    frame = pd.read_csv(StringIO(text), dtype=str, keep_default_na=False)
    if list(frame) != COLUMNS:
        raise ValueError(f"remarks: expected the columns {COLUMNS}, got {list(frame)}")
    if (frame == "").to_numpy().any():
        raise ValueError("remarks: expected every field filled; * stands for anything")
    return {
        (source, case, metric, model): note
        for source, case, metric, model, note in frame.itertuples(index=False)
    }


def remark_on(address: PublishedAddress, remarks: Remarks) -> str:
    """Return the first remark that concerns ``address``, empty where there is none."""
    concerning = (n for patterns, n in remarks.items() if all(map(fnmatchcase, address, patterns)))
    return next(concerning, "")


def marks(notes: Iterable[str]) -> dict[str, str]:
    """Return a letter for every distinct note, in order of appearance; none for an empty one."""
    distinct = dict.fromkeys(note for note in notes if note)
    return {"": "", **dict(zip(distinct, ascii_lowercase, strict=False))}


def footnotes(lettered: dict[str, str]) -> Sequence[str]:
    """Return the notes of `marks` with their letters, as shown below a table."""
    return [f"{letter}: {note}" for note, letter in lettered.items() if letter]
