"""A player of motions, for the page."""

from __future__ import annotations

from typing import Any

from mocapbench.basics.mask_runs import run_bounds
from mocapbench.reports.bundle.pictures import Motions
from mocapbench.reports.motions.encoding import encode, resolution
from mocapbench.reports.text import slug

__all__ = ["player"]

_OTHER_SIDE = {"l": "r", "r": "l"}


def player(picture: Motions) -> dict[str, Any]:
    """Return a player of ``picture`` as the page's template reads it.

    Returns
    -------
    dict
        ``id``, ``title`` and ``caption``; the ``labels`` of the entrants to choose from, and the
        one that is shown ``beside`` the first to begin with; and the ``data`` that a script plays.
    """
    names = list(picture.truths)
    return {
        "id": slug("player", picture.task, picture.title),
        "title": picture.title,
        "caption": picture.caption,
        "labels": tuple(picture.motions),
        "beside": picture.beside,
        "data": {
            "frames": len(picture.hidden),
            "interval": picture.interval,
            "resolution": resolution(picture),
            "parents": picture.parents,
            "sides": [_side(joint, picture.joints) for joint in picture.joints],
            "hidden": run_bounds(picture.hidden).tolist(),
            "truths": names,
            "motions": [[label, names.index(picture.truth_of(label))] for label in picture.motions],
            "positions": encode(picture),
        },
    }


def _side(joint: str, joints: tuple[str, ...]) -> str:
    """Return "l" or "r" of a joint such as ``lfemur`` that the other side has too, else ""."""
    other = _OTHER_SIDE.get(joint[:1], "")
    return joint[0] if other and other + joint[1:] in joints else ""
