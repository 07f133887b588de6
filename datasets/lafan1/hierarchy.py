"""The joints of a BVH file, and what connects them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton
from mocapbench.datasets.formats.errors import FormatError

__all__ = ["parse_hierarchy"]

_INCH = 2.54
"""Centimetres; lengths of the data set are in the latter."""


def parse_hierarchy(lines: Iterable[str], file: str) -> Skeleton:
    """Return the joints of a BVH file, each with its offset from the one that carries it.

    A joint lies at its parent's place plus its offset as the parent's rotation turns it, in
    contrast to a segment of Acclaim files, which its own rotation turns. The root's offset and
    the ends of limbs are left out.

    Parameters
    ----------
    lines : iterable of str
        Of the file, up to ``MOTION`` or further.
    file : str
        Its name, for messages.

    Raises
    ------
    FormatError
        If no joint is found, or one has no offset of three numbers.
    """
    names: list[str] = []
    segments: list[Segment] = []
    carriers: list[str] = []
    for line in lines:
        match line.split():
            case ["ROOT" | "JOINT" | "End", name]:
                names.append(name)
            case ["{"]:
                carriers.append(names[-1] if names else "")
            case ["}"] if carriers:
                carriers.pop()
            case ["OFFSET", *offset] if names and names[-1] != "Site":
                parent = carriers[-2] if len(carriers) > 1 else ""
                segments.append(_build_segment(names[-1], parent, offset, file))
            case ["MOTION"]:
                break
    if not segments:
        advice = "export the recording again as BVH"
        raise FormatError(file, "joints with their offsets", "none", advice)
    return Skeleton("bvh", _INCH, tuple(segments))


def _build_segment(name: str, parent: str, words: list[str], file: str) -> Segment:
    """Return the segment from a joint's parent to it."""
    try:
        x, y, z = map(float, words)
    except ValueError as error:
        advice = "export the recording again as BVH"
        got = " ".join(words) or "nothing"
        raise FormatError(file, f"an OFFSET of {name} with three numbers", got, advice) from error
    offset = np.array([x, y, z]) if parent else np.zeros(3)
    length = float(np.linalg.norm(offset))
    direction = tuple((offset / (length or 1.0)).tolist())
    return Segment(name, parent, direction, length, (0.0, 0.0, 0.0), "XYZ", ())
