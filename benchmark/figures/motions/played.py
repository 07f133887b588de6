"""A player of motions: which entrants and frames it shows, and what beside which truth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.words import format_count
from mocapbench.benchmark.figures.motions.placing import PlacesJoints
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.datasets import FrameByJointBy3, Frames, Recording
from mocapbench.reports import Motions

__all__ = [
    "LONGEST",
    "Chosen",
    "Pair",
    "build_player",
    "choose_entrants",
    "shown_frames",
    "shown_part",
]

Chosen = tuple[tuple[str, ...], str, str]
"""The labels of entrants, best first; the one to show beside the first; and which they are."""


def choose_entrants(solved: Solved[Any, Any], n_most: int) -> Chosen:
    """Return the best entrants by the task's first metric, and the best interpolation.

    Returns
    -------
    labels : tuple of str
        Best first.
    beside : str
        The one to show beside the first: the best interpolation, else the second.
    phrase : str
        Which they are, for a caption.
    """
    ranked = [label for label in solved.ranking if label in solved.solutions]
    ranked += [label for label in solved.solutions if label not in ranked]
    best, others = ranked[:n_most], ranked[n_most:]
    first = [label for label in ranked if label in solved.interpolations][:1]
    labels = (*best, *(label for label in others if label in first))
    beside = next((label for label in (*first, *labels[1:2]) if label != labels[0]), labels[0])
    order = f"best first by {solved.metric} here" if solved.ranking else "in the order of the task"
    if not others:
        return labels, beside, f"All {format_count(len(labels), 'entrant')}, {order}"
    added = " and the best interpolation" if len(labels) > n_most else ""
    return labels, beside, f"The first {n_most} of {len(ranked)} entrants{added}, {order}"


LONGEST = 10.0
"""Seconds."""
_RATE = 30.0
"""Frames per second at the least, where a recording has them; fewer than twice as many."""
_TOLERANCE = 1.001  # 59.99 frames per second are 60


def shown_frames(recording: Recording) -> NDArray[np.intp]:
    """Return which frames to show: at most `LONGEST`, with the first hidden ones in their middle.

    A frame counts as hidden if any of its entries is.
    """
    times, hidden = recording.times, _find_hidden(recording)
    step = max(int(_TOLERANCE * _frame_rate(times) / _RATE), 1)
    rows = np.arange(0, len(times), step)
    first = int(np.argmax(hidden))
    stop = min(_end_of_run(hidden, first), int(np.searchsorted(times, times[first] + LONGEST)))
    middle = (times[first] + times[stop - 1]) / 2.0
    start = np.clip(middle - LONGEST / 2.0, times[0], max(times[-1] - LONGEST, times[0]))
    return np.asarray(rows[(times[rows] >= start) & (times[rows] <= start + LONGEST)])


def _find_hidden(recording: Recording) -> NDArray[np.bool_]:
    return np.asarray(~recording.visible.all(axis=1))


def shown_part(recording: Recording) -> slice:
    """Return the first to the last of the frames to show, with all between."""
    rows = shown_frames(recording)
    return slice(int(rows[0]), int(rows[-1]) + 1)


def _frame_rate(times: Frames) -> float:
    return float((len(times) - 1) / (times[-1] - times[0])) if len(times) > 1 else _RATE


def _end_of_run(hidden: NDArray[np.bool_], first: int) -> int:
    """Return where the run of equal values from ``first`` on has ended."""
    changes = np.flatnonzero(hidden[first:] != hidden[first])
    return first + int(changes[0]) if len(changes) else len(hidden)


Pair = tuple[str, FrameByJointBy3, FrameByJointBy3]
"""The name of a truth, and the joints (P, J, 3) of it and of what an entrant made of it, in the
`shown_part` and in centimetres."""


def build_player(
    solved: Solved[Any, Any],
    body: PlacesJoints,
    given: Recording,
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
    given : Recording
        As models saw it, or as long as what they invented.
    entrants : Chosen
    pairs : sequence of Pair
        In the order of the entrants.
    caption : str
        What the figure shows; how it was cut and who takes part is added.
    """
    joints = tuple(segment.name for segment in body.skeleton.segments)
    rows = shown_frames(given)
    shown = given.times[rows]
    kept = rows - rows[0]
    seen = [side_view(truth[kept], made[kept], joints) for _, truth, made in pairs]
    names, (labels, beside, phrase) = [name for name, _, _ in pairs], entrants
    return Motions(
        task=solved.task,
        title="Motion",
        caption=f"{caption} {_extent(given.times, shown)}. {phrase}.",
        interval=float(np.diff(shown).mean()),
        joints=joints,
        parents=body.skeleton.parents,
        hidden=_find_hidden(given)[rows],
        truths={name: truth for name, (truth, _) in zip(names, seen, strict=True)},
        motions={label: made for label, (_, made) in zip(labels, seen, strict=True)},
        against=dict(zip(labels, names, strict=True)),
        beside=beside,
    )


def _extent(times: Frames, shown: Frames) -> str:
    """Return how much of a recording is shown, and at which rate."""
    whole, part = times[-1] - times[0], shown[-1] - shown[0]
    extent = f"{part:.1f} s at {(len(shown) - 1) / part:.0f} Hz"
    return extent if part > 0.99 * whole else f"{extent}, of {whole:.1f} s, around the first gap"
