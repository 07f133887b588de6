"""Pairs of a truth and what an entrant made of it, as a player shows them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from mocapbench.benchmark.figures.motions.chosen import Chosen
from mocapbench.benchmark.figures.motions.placing import PlacesJoints
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.benchmark.figures.motions.window import ShownWindow
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.datasets import FrameByJointBy3, Frames
from mocapbench.reports import Motion, Motions

__all__ = ["Pair", "build_player"]


class Pair(NamedTuple):
    """What an entrant made, and what it is compared with.

    Parameters
    ----------
    against : str
        Name of the truth.
    truth, made : ndarray of shape (P, J, 3)
        Positions of joints in the `ShownWindow.part`, in centimetres.
    """

    against: str
    truth: FrameByJointBy3
    made: FrameByJointBy3


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
    seen = [side_view(pair.truth[kept], pair.made[kept], joints) for pair in pairs]
    return Motions(
        task=solved.task,
        title="Motion",
        caption=f"{caption} {_extent(window.times, shown)}. {entrants.phrase}.",
        interval=float(np.diff(shown).mean()),
        joints=joints,
        parents=body.skeleton.parents,
        hidden=window.hidden[rows],
        truths={pair.against: truth for pair, (truth, _) in zip(pairs, seen, strict=True)},
        motions=tuple(
            Motion(label, made, pair.against)
            for label, pair, (_, made) in zip(entrants.labels, pairs, seen, strict=True)
        ),
        beside=entrants.beside,
    )


def _extent(times: Frames, shown: Frames) -> str:
    """Return how much of a recording is shown, and at which rate."""
    whole, part = times[-1] - times[0], shown[-1] - shown[0]
    extent = f"{part:.1f} s at {(len(shown) - 1) / part:.0f} Hz"
    return extent if part > 0.99 * whole else f"{extent}, of {whole:.1f} s, around the first gap"
