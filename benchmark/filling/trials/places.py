"""At how many places of a recording trial gaps are.

In a short recording, or with long gaps, trial gaps overlap: fifteen of 60 frames may lie at two
places, a frame or two apart. Their errors are then nearly the same, and no more evidence than two
are. So those at one place are one unit of a test.

Trial gaps that are linked by others in between need not be at one place: 24 of 90 frames may cover
a recording of 600 frames without a break. A place is therefore a trial gap with those that share
frames with it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.filling.trials.trial import Trial

__all__ = ["places_of"]

_BESIDE = 1
"""Frames on each side that belong to a trial gap: what is filled goes on from them."""


def places_of(trials: Sequence[Trial]) -> NDArray[np.intp]:
    """Return the place of each trial gap (n,), numbered along the recording from 0.

    The first trial gaps to end at each place share no frames with each other, and there are as many
    of them as there can be.
    """
    copies = [copy for trial in trials for copy in trial.copies]
    places = np.empty(len(copies), dtype=np.intp)
    place, stop = -1, -np.inf
    for number in sorted(range(len(copies)), key=lambda n: copies[n].stop):
        if copies[number].start - _BESIDE >= stop:
            place, stop = place + 1, copies[number].stop + _BESIDE
        places[number] = place
    return places
