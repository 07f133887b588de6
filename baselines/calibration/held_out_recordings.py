"""Held-out recordings: training recordings that take the place of the one to fill.

They are left out of training, and have the gaps of the one to fill. They say what a model makes of
gaps as long as these, which copies in the recording itself may not; but they know nothing of the
person.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from sklearn.base import clone

from mocapbench.baselines.calibration.error_ratios import sum_ratios
from mocapbench.baselines.calibration.held_out_gaps import remoteness
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.protocols import FrameImputer
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["cut_to_length", "hold_out_recordings", "sum_ratios_elsewhere"]

_MOST = 3
"""Training recordings that take the place of the one to fill."""
_MANY = 4
"""How many times as many recordings as are held out are enough to learn from."""


def hold_out_recordings(
    recordings: Sequence[Recording], given: Recording
) -> list[tuple[list[Recording], list[Recording]]]:
    """Return who is held out together and who is left, each time; nothing if nobody would be left.

    Those held out are spread evenly over the recordings `by_content`. Where many are left to learn
    from, they are held out at once.

    Parameters
    ----------
    recordings : sequence of Recording
        What is learnt from; the one to fill, which may be among them, is never held out.
    given : Recording
        The one to fill.
    """
    others = by_content([one for one in recordings if one.name != given.name])
    if len(recordings) < 2:
        return []
    positions = np.unique(np.linspace(0, len(others) - 1, _MOST).round().astype(int))
    chosen = [others[position] for position in positions]
    at_once = len(others) > _MANY * len(chosen)
    return [
        (held_out, [r for r in recordings if r.name not in {one.name for one in held_out}])
        for held_out in ([chosen] if at_once else [[one] for one in chosen])
    ]


def cut_to_length(recording: Recording, masks: Sequence[Mask]) -> list[tuple[Recording, Mask]]:
    """Cut a recording and masks to the shorter of their lengths, around the gaps."""
    n_frames, n_masked = len(recording.times), len(masks[0])
    length = min(n_frames, n_masked)
    cut = recording.frames((n_frames - length) // 2 + np.arange(length))
    middle = int(np.flatnonzero(masks[0].any(axis=1)).mean())
    first = min(max(middle - length // 2, 0), n_masked - length)
    return [(cut, mask[first : first + length]) for mask in masks]


def sum_ratios_elsewhere(
    model: FrameImputer, learnt_from: Sequence[Recording], given: Recording, masks: Sequence[Mask]
) -> Array:
    """Return the sums of error ratios in held-out recordings, and their numbers: (M, 2, D).

    Parameters
    ----------
    model : FrameImputer
        It learns anew without those held out.
    learnt_from : sequence of Recording
        What it has learnt from.
    given : Recording
        The recording to fill.
    masks : sequence of Mask
        M sets of entries (N, D) that count: the gaps, or what else is hidden besides them.
    """
    totals = np.zeros((len(masks), 2, len(given.channels)))
    for held_out, left in hold_out_recordings(learnt_from, given):
        try:
            rest = clone(model).fit(left)
        except ValueError:  # What is left may be too little to learn from.
            continue
        for number, ratios in _compute_ratios(rest, held_out, ~given.visible, masks):
            totals[number] += ratios
    return totals


def _compute_ratios(
    rest: FrameImputer, held_out: Sequence[Recording], hidden: Mask, masks: Sequence[Mask]
) -> Iterator[tuple[int, Array]]:
    for number, (cut, gap, mask) in _lay_over(held_out, hidden, masks):
        try:
            (prediction,) = rest.impute([cut.hide(gap | mask)])
        except ValueError:  # A channel may be visible nowhere else.
            continue
        yield number, sum_ratios(cut, mask, prediction)


def _lay_over(
    held_out: Sequence[Recording], hidden: Mask, masks: Sequence[Mask]
) -> Iterator[tuple[int, tuple[Recording, Mask, Mask]]]:
    """Yield each recording, the gaps and each of the masks, by number.

    A recording in which the gaps reach less or further than in the one to fill, because it is
    shorter, says nothing of them.
    """
    for recording in held_out:
        (_, gap), *cuts = cut_to_length(recording, [hidden, *masks])
        if np.array_equal(remoteness(gap, gap), remoteness(hidden, hidden)):
            yield from enumerate((cut, gap, mask) for cut, mask in cuts)
