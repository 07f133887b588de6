"""A player of motions, as a figure of the page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mocapbench.basics.gaps import run_bounds
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
        "hidden": run_bounds(picture.hidden).tolist(),
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
