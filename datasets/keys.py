"""Keys of the form ``SUBJECT_TRIAL``, such as ``35_02``, by which CMU names its recordings."""

from __future__ import annotations

import re

__all__ = ["MARKERS", "split_key", "subject_of"]

MARKERS = ".c3d"
"""What ends a key that stands for the markers of a recording, such as ``135_02.c3d``."""

_KEY = re.compile(r"([0-9]{2,3})_([0-9]{2})")


def split_key(key: str) -> tuple[str, str]:
    """Return subject and trial of a key such as ``35_02``.

    Raises
    ------
    ValueError
        If the key is malformed.
    """
    match = _KEY.fullmatch(key)
    if match is None:
        raise ValueError(f"expected a recording as SUBJECT_TRIAL, such as 35_02, got {key!r}")
    return match[1], match[2]


def subject_of(address: str) -> str:
    """Return whose recording ``cmu:35_02``, ``35_02`` or ``35_02.c3d`` is: subject ``35``.

    Raises
    ------
    ValueError
        If the key is malformed.
    """
    return split_key(address.rpartition(":")[2].removesuffix(MARKERS))[0]
