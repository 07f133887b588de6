"""Where the scores of one cell come from: what computes it again, and what it was computed from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["Origin"]


@dataclass(frozen=True)
class Origin:
    """The origin of one cell, that is of all folds of an entrant on a case.

    Parameters
    ----------
    command : tuple of str
        Pieces of the shell command that computes this cell alone, joined by blanks. Cells share
        most pieces.
    seed : int
        The root seed.
    keys : mapping of int to str
        The key of each fold's record, which names its file.
    recordings : mapping of str to str
        The digest of each recording of the case, by address; empty where motion is generated.
    """

    command: tuple[str, ...]
    seed: int
    keys: Mapping[int, str]
    recordings: Mapping[str, str]
