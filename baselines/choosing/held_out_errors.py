"""Errors of the candidates in held-out gaps of the recording, and in held-out recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import pandas as pd

from mocapbench.baselines.calibration.held_out_gaps import hold_out_channels, hold_out_gaps
from mocapbench.baselines.calibration.held_out_recordings import (
    cut_to_length,
    hold_out_recordings,
)
from mocapbench.baselines.choosing.candidates import FittedCandidates
from mocapbench.baselines.choosing.parts import EVERYTHING, GAPS, Part
from mocapbench.baselines.common.checks import pool
from mocapbench.baselines.common.scaling import unit_scales
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import Mask, Recording

__all__ = ["HeldOutErrors", "Products"]

Products = pd.DataFrame
"""(C, C) mean products of the errors of models, by name, in units of the channels' scales.

Mean squared errors are on the diagonal; what is beside it says which models err alike.
"""

Errors = tuple[Mapping[str, Array], Mask]
"""The errors (N, D) of each model in units of the channels' scales, NaN where nothing is held out;
and all that was hidden (N, D)."""


class HeldOutErrors:
    """The errors of candidates where a recording to fill, or others in its place, are known.

    Parameters
    ----------
    fitted : sequence of Recording
        What models learn from.
    candidates : FittedCandidates
        The models, fitted to them.
    given : Recording
        The recording to fill.
    """

    def __init__(
        self, fitted: Sequence[Recording], candidates: FittedCandidates, given: Recording
    ) -> None:
        self.fitted = fitted
        self.candidates = candidates
        self.given = given

    @cached_property
    def held_out(self) -> list[Mask]:
        """What each set of held-out gaps hides in the recording itself."""
        return [*self._copies, *hold_out_channels(self.given)]

    @cached_property
    def _copies(self) -> list[Mask]:
        return hold_out_gaps(self.given)

    def are_short(self, part: Part = EVERYTHING) -> bool:
        """Return whether copies of the longest gap of a part's kind had to be shortened."""
        hidden = ~self.given.visible
        copies = [mask & part.kind(hidden | mask) for mask in self.held_out]
        return _longest(copies) < _longest([hidden & part.kind(hidden)])

    def in_recording(self, part: Part = EVERYTHING) -> list[Products]:
        """Return the products of errors in the recording itself, for each set of held-out gaps."""
        return [_average_products(errors, part) for errors in self._in_recording]

    def n_entries(self, part: Part) -> float:
        """Return how many entries of a part are held out, in all."""
        hidden = ~self.given.visible
        of_part = [mask & part.entries(hidden | mask) for mask in self.held_out]
        return float(np.count_nonzero([mask & self.given.visible for mask in of_part]))

    def elsewhere(self, part: Part = EVERYTHING) -> list[tuple[Products, Products]]:
        """Return those in held-out recordings, with the gaps and with a copy of them.

        A held-out recording has the gaps of the one to fill. Only copies that had to be shorter
        are held out there besides.
        """
        return [
            (_average_products(gaps, part), _average_products(copy, part))
            for gaps, copy in self._elsewhere
        ]

    @cached_property
    def _in_recording(self) -> list[Errors]:
        return [self._hold_out(mask) for mask in self.held_out]

    def _hold_out(self, mask: Mask) -> Errors:
        """Return the errors in held-out gaps, which no model has seen in fitting."""
        shown = self.given.hide(mask)
        candidates = self.candidates
        if self.given.name in [recording.name for recording in self.fitted]:
            candidates = candidates.anew(pool(self.fitted, [shown]))
        return self._compute_errors(candidates, self.given, mask)

    @cached_property
    def _elsewhere(self) -> list[tuple[Errors, Errors]]:
        found = []
        for held_out, left in hold_out_recordings(self.fitted, self.given):
            candidates = self.candidates.anew(left)
            found += [self._put_in_place(candidates, recording) for recording in held_out]
        return found

    def _put_in_place(
        self, candidates: FittedCandidates, recording: Recording
    ) -> tuple[Errors, Errors]:
        middle = len(self._copies) // 2
        short = self._copies[middle : middle + 1] if self.are_short(GAPS) else []
        masks = [~self.given.visible, *short]
        (cut, hidden), *shorter = cut_to_length(recording, masks)
        gaps = self._compute_errors(candidates, cut, hidden)
        copies = [
            self._compute_errors(candidates, cut.hide(hidden), mask, cut) for _, mask in shorter
        ]
        return gaps, copies[0] if copies else ({}, hidden)

    def _compute_errors(
        self,
        candidates: FittedCandidates,
        given: Recording,
        mask: Mask,
        truth: Recording | None = None,
    ) -> Errors:
        """Return the candidates' errors where ``mask`` hides entries of ``given``."""
        known, shown = mask & (truth or given).visible, given.hide(mask)
        if not known.any():
            return {}, ~shown.visible
        values = (truth or given).values
        by_model = {
            name: np.where(known, (mean - values) / self.scale, np.nan)
            for name, mean in candidates.means(shown).items()
        }
        return by_model, ~shown.visible

    @cached_property
    def scale(self) -> Array:
        """(D,) the mean spread of the channels of each channel's unit: units count alike."""
        return unit_scales([*self.fitted, self.given])


def _average_products(errors: Errors, part: Part) -> Products:
    """Return the mean products of the errors in a part, if any of it is held out."""
    by_model, hidden = errors
    entries = part.entries(hidden)
    of_part = [error[entries] for error in by_model.values()]
    rows = [each[~np.isnan(each)] for each in of_part]
    if not rows or not len(rows[0]):
        return pd.DataFrame()
    stacked, names = np.array(rows), [*by_model]
    return pd.DataFrame(stacked @ stacked.T / stacked.shape[1], names, names)


def _longest(masks: Sequence[Mask]) -> int:
    return max(
        (len(run) for mask in masks for run in runs(np.asarray(mask.any(axis=1)))), default=0
    )
