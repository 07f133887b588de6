"""Pairs of a truth and what an entrant made of it, as a player shows them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mocapbench.benchmark.figures.motions.chosen import Chosen
from mocapbench.benchmark.figures.motions.placing import PlacesJoints
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.benchmark.figures.motions.window import ShownWindow
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.datasets import FrameByJointBy3, Frames
from mocapbench.reports import Motion, Motions

__all__ = ["Pair", "build_player"]


Pair = tuple[str, FrameByJointBy3, FrameByJointBy3]
"""The name of a truth, and the joints (P, J, 3) of it and of what an entrant made of it, in the
`ShownWindow.part` and in centimetres."""


def build_player(
    solved: Solved[Any, Any],
    body: PlacesJoints,
    window: ShownWindow,
    *,
    entrants: Chosen,
    pairs: Sequence[Pair],
    caption: str,
) -> Motions:
    """Return a player of one pair for each entrant, cut to the frames to show.

    Parameters
    ----------
    solved : Solved
    body : PlacesJoints
    window : ShownWindow
    entrants : Chosen
    pairs : sequence of Pair
        In the order of the entrants.
    caption : str
        What the figure shows; how it was cut and who takes part is added.
    """
    joints = tuple(segment.name for segment in body.skeleton.segments)
    rows, shown = window.rows, window.times[window.rows]
    kept = rows - rows[0]
    seen = [side_view(truth[kept], made[kept], joints) for _, truth, made in pairs]
    names, (labels, beside, phrase) = [name for name, _, _ in pairs], entrants
    return Motions(
        task=solved.task,
        title="Motion",
        caption=f"{caption} {_extent(window.times, shown)}. {phrase}.",
        interval=float(np.diff(shown).mean()),
        joints=joints,
        parents=body.skeleton.parents,
        hidden=window.hidden[rows],
        truths={name: truth for name, (truth, _) in zip(names, seen, strict=True)},
        motions=tuple(
            Motion(label, made, name)
            for label, name, (_, made) in zip(labels, names, seen, strict=True)
        ),
        beside=beside,
    )


def _extent(times: Frames, shown: Frames) -> str:
    """Return how much of a recording is shown, and at which rate."""
    whole, part = times[-1] - times[0], shown[-1] - shown[0]
    extent = f"{part:.1f} s at {(len(shown) - 1) / part:.0f} Hz"
    return extent if part > 0.99 * whole else f"{extent}, of {whole:.1f} s, around the first gap"
