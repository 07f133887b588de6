"""Rehearsals: gaps where the truth is visible, in the recording to fill and in training."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from mocapbench.baselines.choosing.candidates import FittedCandidates
from mocapbench.baselines.choosing.parts import EVERYTHING, GAPS, Part
from mocapbench.baselines.common.checks import pool
from mocapbench.baselines.common.scaling import unit_scales
from mocapbench.baselines.rehearsal.lost_channels import lost_trials
from mocapbench.baselines.rehearsal.stand_ins import aligned, turns
from mocapbench.baselines.rehearsal.trials import trial_masks
from mocapbench.basics.arrays import Array
from mocapbench.basics.gaps import runs
from mocapbench.datasets import Mask, Recording

__all__ = ["Products", "Rehearsals"]

Products = pd.DataFrame
"""(C, C) mean products of the errors of models, by name, in units of the channels' scales.

Mean squared errors are on the diagonal; what is beside it says which models err alike.
"""


@dataclass(frozen=True, eq=False)
class Errors:
    """What models err in a rehearsal.

    Parameters
    ----------
    by_model : mapping of str to ndarray (N, D)
        In units of the channels' scales; NaN if not rehearsed.
    hidden : ndarray of bool (N, D)
        What models did not see.
    """

    by_model: Mapping[str, Array]
    hidden: Mask

    def products(self, part: Part) -> Products:
        """Return the mean products of the errors in a part, if any of it is rehearsed."""
        entries = part.entries(self.hidden)
        parts = [error[entries] for error in self.by_model.values()]
        rows = [errors[~np.isnan(errors)] for errors in parts]
        if not rows or not len(rows[0]):
            return pd.DataFrame()
        stacked, names = np.array(rows), [*self.by_model]
        return pd.DataFrame(stacked @ stacked.T / stacked.shape[1], names, names)


@dataclass(frozen=True, eq=False)
class Rehearsals:
    """How a recording to fill can be rehearsed.

    Parameters
    ----------
    fitted : sequence of Recording
        What models learn from.
    candidates : FittedCandidates
        The models, fitted to them.
    given : Recording
        The recording to fill.
    """

    fitted: Sequence[Recording]
    candidates: FittedCandidates
    given: Recording

    @cached_property
    def trials(self) -> list[Mask]:
        """What each rehearsal in the recording itself hides."""
        return [*self._copies, *lost_trials(self.given)]

    @cached_property
    def _copies(self) -> list[Mask]:
        return trial_masks(self.given)

    def are_short(self, part: Part = EVERYTHING) -> bool:
        """Return whether copies of the longest gap of a part's kind had to be shortened."""
        hidden = ~self.given.visible
        copies = [trial & part.kind.entries(hidden | trial) for trial in self.trials]
        return _longest(copies) < _longest([hidden & part.kind.entries(hidden)])

    def own(self, part: Part = EVERYTHING) -> list[Products]:
        """Return the products of errors in the recording itself, for each trial."""
        return [errors.products(part) for errors in self._own]

    def n_entries(self, part: Part) -> float:
        """Return how many entries of a part the trials hide, in all."""
        hidden = ~self.given.visible
        rehearsed = [trial & part.entries(hidden | trial) for trial in self.trials]
        return float(np.count_nonzero([mask & self.given.visible for mask in rehearsed]))

    def in_training(self, part: Part = EVERYTHING) -> list[tuple[Products, Products]]:
        """Return those of training recordings held out in turn, with the gaps and in a trial.

        The recording held out has the gaps of the one to fill. Only copies that had to be shorter
        are tried besides.
        """
        return [(full.products(part), copy.products(part)) for full, copy in self._in_training]

    @cached_property
    def _own(self) -> list[Errors]:
        return [self._in_trial(mask) for mask in self.trials]

    def _in_trial(self, mask: Mask) -> Errors:
        """Return the errors in a trial, which no model has seen in fitting."""
        tried = self.given.hide(mask)
        candidates = self.candidates
        if self.given.name in [recording.name for recording in self.fitted]:
            candidates = candidates.anew(pool(self.fitted, [tried]))
        return self._errors(candidates, self.given, mask)

    @cached_property
    def _in_training(self) -> list[tuple[Errors, Errors]]:
        found = []
        for held_out, left in turns(self.fitted, self.given):
            candidates = self.candidates.anew(left)
            found += [self._in_place_of_given(candidates, recording) for recording in held_out]
        return found

    def _in_place_of_given(
        self, candidates: FittedCandidates, recording: Recording
    ) -> tuple[Errors, Errors]:
        middle = len(self._copies) // 2
        short = self._copies[middle : middle + 1] if self.are_short(GAPS) else []
        masks = [~self.given.visible, *short]
        gaps, *trials = aligned(recording, masks)
        cut, hidden = gaps
        full = self._errors(candidates, cut, hidden)
        copies = [self._errors(candidates, cut.hide(hidden), mask, cut) for _, mask in trials]
        return full, copies[0] if copies else Errors({}, hidden)

    def _errors(
        self,
        candidates: FittedCandidates,
        given: Recording,
        mask: Mask,
        truth: Recording | None = None,
    ) -> Errors:
        """Return the candidates' errors where ``mask`` hides entries of ``given``."""
        known, tried = mask & (truth or given).visible, given.hide(mask)
        if not known.any():
            return Errors({}, ~tried.visible)
        values = (truth or given).values
        by_model = {
            name: np.where(known, (mean - values) / self.scale, np.nan)
            for name, mean in candidates.means(tried).items()
        }
        return Errors(by_model, ~tried.visible)

    @cached_property
    def scale(self) -> Array:
        """(D,) the mean spread of the channels of each channel's unit: units count alike."""
        return unit_scales([*self.fitted, self.given])


def _longest(masks: Sequence[Mask]) -> int:
    return max(
        (len(run) for mask in masks for run in runs(np.asarray(mask.any(axis=1)))), default=0
    )
