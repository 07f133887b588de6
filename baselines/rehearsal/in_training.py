"""How a model's claims stand up in training recordings that take the place of the one to fill."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from sklearn.base import clone

from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.ratios import squared_ratios
from mocapbench.baselines.rehearsal.stand_ins import aligned, turns
from mocapbench.baselines.rehearsal.trials import remoteness
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["ratios_in_training"]


def ratios_in_training(
    model: Widened, learnt_from: Sequence[Recording], given: Recording, masks: Sequence[Mask]
) -> Array:
    """Return the sums of squared errors over claims, and their numbers, by mask: (M, 2, D).

    Training recordings are held out in turn, and have the gaps of the one to fill.

    Parameters
    ----------
    model : Widened
        Learnt anew without those held out.
    learnt_from : sequence of Recording
        What it has learnt from.
    given : Recording
        The recording to fill.
    masks : sequence of Mask
        Entries (N, D) that count: its gaps, or what else is hidden besides them.
    """
    totals = np.zeros((len(masks), 2, len(given.channels)))
    for held_out, left in turns(learnt_from, given):
        try:
            rest = clone(model).fit(left)
        except ValueError:  # What is left may be too little to learn from.
            continue
        for number, ratios in _ratios(rest, held_out, ~given.visible, masks):
            totals[number] += ratios
    return totals


def _ratios(
    rest: Widened, held_out: Sequence[Recording], hidden: Mask, masks: Sequence[Mask]
) -> Iterator[tuple[int, Array]]:
    for number, (cut, gap, mask) in _in_place(held_out, hidden, masks):
        try:
            (answer,) = rest.as_claimed([cut.hide(gap | mask)])
        except ValueError:  # A channel may be visible nowhere else.
            continue
        yield number, squared_ratios(cut, mask, answer)


def _in_place(
    held_out: Sequence[Recording], hidden: Mask, masks: Sequence[Mask]
) -> Iterator[tuple[int, tuple[Recording, Mask, Mask]]]:
    """Yield each recording, the gaps and each of the masks, by number.

    A recording in which the gaps reach less or further than in the one to fill, because it is
    shorter, says nothing of them.
    """
    for recording in held_out:
        (_, gap), *cuts = aligned(recording, [hidden, *masks])
        if np.array_equal(remoteness(gap, gap), remoteness(hidden, hidden)):
            yield from enumerate((cut, gap, mask) for cut, mask in cuts)
