"""Remarks on the papers' numbers, as data: errata, and reasons why numbers are not comparable.

``errata.csv`` and ``not_comparable.csv`` hold one remark a row. Each of ``source``, ``case``,
``metric`` and ``model`` is a pattern, where ``*`` stands for anything and ``[47]`` for 4 or 7.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from io import StringIO
from string import ascii_lowercase

import pandas as pd

__all__ = ["PublishedAddress", "Remark", "footnotes", "marks", "parse_remarks", "remark_on"]

COLUMNS = ["source", "case", "metric", "model", "note"]

PublishedAddress = tuple[str, str, str, str]
"""Source, case, metric and model of a number, in the paper's names."""


@dataclass(frozen=True)
class Remark:
    """A note on every number whose address matches the patterns."""

    patterns: PublishedAddress
    note: str

    def concerns(self, address: PublishedAddress) -> bool:
        """Return whether the remark is about the number at ``address``."""
        return all(map(fnmatchcase, address, self.patterns))


def parse_remarks(text: str) -> tuple[Remark, ...]:
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
    return tuple(
        Remark((source, case, metric, model), note)
        for source, case, metric, model, note in frame.itertuples(index=False)
    )


def remark_on(address: PublishedAddress, remarks: Iterable[Remark]) -> str:
    """Return the first remark that concerns ``address``, empty where there is none."""
    return next((remark.note for remark in remarks if remark.concerns(address)), "")


def marks(notes: Iterable[str]) -> dict[str, str]:
    """Return a letter for every distinct note, in order of appearance; none for an empty one."""
    distinct = dict.fromkeys(note for note in notes if note)
    return {"": "", **dict(zip(distinct, ascii_lowercase, strict=False))}


def footnotes(lettered: dict[str, str]) -> Sequence[str]:
    """Return the notes of `marks` with their letters, as shown below a table."""
    return [f"{letter}: {note}" for note, letter in lettered.items() if letter]
