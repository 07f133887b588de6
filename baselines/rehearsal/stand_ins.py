"""Training recordings that take the place of the one to fill, left out of training.

They say what a model makes of gaps as long as those to fill, which copies in the recording itself
may not; but they know nothing of the person.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.common.recordings import by_name
from mocapbench.datasets import Mask, Recording

__all__ = ["Turn", "aligned", "turns"]

Turn = tuple[list[Recording], list[Recording]]
"""Recordings that are held out together, and those that are left to learn from."""

_MOST = 3
"""Training recordings that take the place of the one to fill."""
_MANY = 4
"""How many times as many recordings as are held out are enough to learn from."""


def turns(recordings: Sequence[Recording], given: Recording) -> list[Turn]:
    """Return who is held out and who is left, for each turn; no turn if nobody would be left.

    Those held out are spread evenly over the recordings by name. Where many are left to learn from,
    they share one turn.

    Parameters
    ----------
    recordings : sequence of Recording
        What is learnt from; the one to fill, which may be among them, is never held out.
    given : Recording
        The one to fill.
    """
    others = by_name([one for one in recordings if one.name != given.name])
    if len(recordings) < 2:
        return []
    places = np.unique(np.linspace(0, len(others) - 1, _MOST).round().astype(int))
    chosen = [others[place] for place in places]
    shared = len(others) > _MANY * len(chosen)
    return [
        (held_out, [r for r in recordings if r.name not in {one.name for one in held_out}])
        for held_out in ([chosen] if shared else [[one] for one in chosen])
    ]


def aligned(recording: Recording, masks: Sequence[Mask]) -> list[tuple[Recording, Mask]]:
    """Cut a recording and masks to the shorter of their lengths, around the gaps."""
    n_frames, n_masked = len(recording.times), len(masks[0])
    length = min(n_frames, n_masked)
    cut = recording.frames((n_frames - length) // 2 + np.arange(length))
    middle = int(np.flatnonzero(masks[0].any(axis=1)).mean())
    first = min(max(middle - length // 2, 0), n_masked - length)
    return [(cut, mask[first : first + length]) for mask in masks]
