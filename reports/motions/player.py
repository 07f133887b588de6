"""A player of motions, as a figure of the page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.reports.bundle.motions import Motions
from mocapbench.reports.motions.encoding import encode, resolution
from mocapbench.reports.text import slug

__all__ = ["PlayerFigure", "draw"]

_OTHER_SIDE = {"l": "r", "r": "l"}


@dataclass(frozen=True)
class PlayerFigure:
    """A motion player.

    Parameters
    ----------
    id, title, caption : str
    labels : tuple of str
        The entrants to choose from.
    beside : str
        The one that is shown beside the first to begin with.
    data : mapping
        What the page's script plays.
    """

    id: str
    title: str
    caption: str
    labels: tuple[str, ...]
    beside: str
    data: dict[str, Any]


def draw(picture: Motions) -> PlayerFigure:
    """Return ``picture`` as a figure of the page."""
    names = list(picture.truths)
    data = {
        "frames": len(picture.hidden),
        "interval": picture.interval,
        "resolution": resolution(picture),
        "parents": picture.parents,
        "sides": [_side(joint, picture.joints) for joint in picture.joints],
        "hidden": _runs(picture.hidden),
        "truths": names,
        "motions": [[motion.label, names.index(motion.against)] for motion in picture.motions],
        "positions": encode(picture),
    }
    labels = tuple(motion.label for motion in picture.motions)
    name = slug("player", picture.task, picture.title)
    return PlayerFigure(name, picture.title, picture.caption, labels, picture.beside, data)


def _side(joint: str, joints: tuple[str, ...]) -> str:
    """Return "l" or "r" of a joint such as ``lfemur`` that the other side has too, else ""."""
    other = _OTHER_SIDE.get(joint[:1], "")
    return joint[0] if other and other + joint[1:] in joints else ""


def _runs(hidden: NDArray[np.bool_]) -> list[list[int]]:
    """Return where each run of True begins, and where it has ended."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], hidden, [False]]).astype(int)))
    return [[start, stop] for start, stop in edges.reshape(-1, 2).tolist()]
