"""What is asked for: which entries of a recording are to be filled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gap_problem import (
    GapProblem,
    cut_blank_ends,
    select_channels,
)
from mocapbench.benchmark.filling.gaps import Gap, find_gaps, mask_ends, mask_gaps
from mocapbench.benchmark.filling.requests.channels import match_channels
from mocapbench.benchmark.filling.requests.refusals import (
    NothingToFillError,
    explain_all_left,
    explain_no_gap,
    explain_nothing_known,
    explain_only_ends,
)
from mocapbench.benchmark.filling.requests.rules import BEST, assign_models, mark_left
from mocapbench.datasets import Mask, Recording, unwrap_angles
from mocapbench.datasets.formats.strays import is_unlabelled

__all__ = ["BEST", "FillRequest", "NamedEntries", "measure_gap", "select"]


@dataclass(frozen=True)
class NamedEntries:
    """Which entries the user names; by default every hidden one between visible ones.

    Parameters
    ----------
    frames : tuple of int or None
        Frames [first, stop), 0-based, which are filled whether the file has values there or not.
    channels : tuple of str
        Names of markers, joints or channels, or patterns as those of a shell, see `match_pattern`.
        Without any, all channels but those of unlabelled markers and of results of a model of the
        body are meant.
    max_gap : float or None
        Seconds; longer gaps stay open.
    fill_ends : bool
        Whether hidden entries before the first visible one of their channel and after the last are
        filled, too, where anything is visible.
    model : str
        Which model fills them, or `BEST`, or rules of which fills what, see `assign_models`.
    leave, only : tuple of str
        Rules of which gaps stay open, and of which alone do not, see `mark_left`.
    """

    frames: tuple[int, int] | None = None
    channels: tuple[str, ...] = ()
    max_gap: float | None = None
    fill_ends: bool = False
    model: str = BEST
    leave: tuple[str, ...] = ()
    only: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class FillRequest:
    """A recording, and which of its entries to fill.

    Parameters
    ----------
    given : Recording
        N frames of D channels, of which all entries to fill are hidden.
    target : ndarray of bool of shape (N, D)
        The entries to fill.
    models : ndarray of str of shape (M,)
        By which model to fill each of them, in the order of ``np.nonzero(target)``, or `BEST`.
    train : tuple of Recording
        Others that models learn from, with the channels of this one, in its order.
    left_open : tuple of Gap
        Gaps that were asked for, and are longer than allowed.
    unlabelled : tuple of str
        Channels of unlabelled markers that have hidden entries, and that nobody named.
    unknown : tuple of str
        Channels that were asked for, and of which there is nothing to fill them from.
    replaced : int
        How many of the entries that are filled had a value.
    outputs : tuple of str
        Channels of results of a model of the body that have hidden entries, and that nobody named.
    results : tuple of str
        All channels of results of a model of the body.
    open_ends : tuple of Gap
        What is hidden before the first visible entry of a channel or after the last, and nobody
        asked for.
    blank_ends : tuple of Gap
        What is hidden in frames before or after those in which anything is visible.
    left_by_hand : tuple of Gap
        Gaps of ``target`` that models fill like others, as if they were wanted, and that stay open.
    """

    given: Recording
    target: Mask
    models: NDArray[np.str_]
    train: tuple[Recording, ...] = ()
    left_open: tuple[Gap, ...] = ()
    unlabelled: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    replaced: int = 0
    outputs: tuple[str, ...] = ()
    results: tuple[str, ...] = ()
    open_ends: tuple[Gap, ...] = ()
    blank_ends: tuple[Gap, ...] = ()
    left_by_hand: tuple[Gap, ...] = ()

    @property
    def kept(self) -> NDArray[np.bool_]:
        """Which entries to fill (M,) do not stay open by the user's hand."""
        return np.asarray(~mask_gaps(self.left_by_hand, self.target.shape)[self.target])

    def drop_left(self) -> Self:
        """Return the request without entries to fill that stay open by the user's hand."""
        kept = self.target & ~mask_gaps(self.left_by_hand, self.target.shape)
        return replace(self, target=kept, models=self.models[self.kept])

    @cached_property
    def gaps(self) -> tuple[Gap, ...]:
        """The gaps to fill."""
        return find_gaps(self.target)

    @property
    def problem(self) -> GapProblem:
        """What models are to fill.

        It is without unlabelled markers and results of a model of the body of which nothing is to
        be filled, and without frames at the ends in which nothing else is visible.
        """
        wanted = match_channels(self.given, (), self.results) | self.target.any(axis=0)
        problem = GapProblem(self.given, self.target, self.train)
        return cut_blank_ends(select_channels(problem, wanted))


def select(
    recording: Recording,
    entries: NamedEntries,
    train: Sequence[Recording] = (),
    results: Sequence[str] = (),
) -> FillRequest:
    """Return the request of filling the entries named.

    Channels of which nothing is visible, here or in recordings to learn from, stay as they are, and
    results of a model of the body do unless they are named.

    Raises
    ------
    NothingToFillError
        If no entry is to be filled.
    UsageError
        If frames or channels are not in the recording, or nothing is visible.
    """
    asked = _select_entries(recording, entries, results)
    incomplete = _find_incomplete(recording, asked)
    unlabelled = tuple(filter(is_unlabelled, incomplete))
    outputs = tuple(name for name in results if name in incomplete)
    if not asked.any():
        raise NothingToFillError(explain_no_gap(recording, entries.channels, unlabelled, outputs))
    given = recording.hide(asked)
    if not given.visible.any():
        raise UsageError(
            f"{recording.name}: expected visible entries to fill the others from, got none; "
            "name fewer frames or channels"
        )
    known = np.any([one.visible.any(axis=0) for one in (given, *train)], axis=0)
    unknown = _name_channels(recording, asked.any(axis=0) & ~known)
    open_ends, blank_ends = _mark_unfilled_ends(recording, entries, asked & known, results)
    named = asked & known & ~open_ends & ~blank_ends
    ends = find_gaps(open_ends), find_gaps(blank_ends)
    if not named.any():
        if any(ends):
            raise NothingToFillError(explain_only_ends(recording, *ends))
        raise UsageError(explain_nothing_known(recording, unknown))
    left_open = _find_longer_gaps(recording, named, entries.max_gap)
    target = named & ~mask_gaps(left_open, named.shape)
    left_by_hand = mark_left(recording, target, entries.leave, entries.only)
    if left_by_hand[target].all():
        raise NothingToFillError(explain_all_left(recording))
    replaced = int((target & ~left_by_hand & recording.visible).sum())
    open_too = recording.hide(named)
    return FillRequest(
        unwrap_angles(open_too),
        target,
        assign_models(recording, target, entries.model),
        tuple(train),
        left_open,
        unlabelled,
        unknown,
        replaced,
        outputs,
        tuple(results),
        *ends,
        find_gaps(left_by_hand),
    )


def _find_longer_gaps(recording: Recording, named: Mask, max_gap: float | None) -> tuple[Gap, ...]:
    """Return the gaps that are longer than allowed, which are not all."""
    gaps, limit = find_gaps(named), np.inf if max_gap is None else max_gap
    longer = tuple(gap for gap in gaps if not measure_gap(recording, gap) <= limit)
    if len(longer) == len(gaps):
        shortest = min(measure_gap(recording, gap) for gap in gaps)
        raise NothingToFillError(
            f"{recording.name}: expected a gap of {limit:g} s or less, got "
            f"{len(gaps)} of {shortest:.3g} s or more; raise --max-gap"
        )
    return longer


def _select_entries(recording: Recording, entries: NamedEntries, results: Sequence[str]) -> Mask:
    """Return the entries (N, D) that are asked for: given frames, or else what is hidden."""
    rows = ~recording.visible if entries.frames is None else _mark_frames(recording, entries.frames)
    return rows & match_channels(recording, entries.channels, results)


def _mark_unfilled_ends(
    recording: Recording, entries: NamedEntries, asked: Mask, results: Sequence[str]
) -> tuple[Mask, Mask]:
    """Return which asked entries (N, D) at the ends stay open, and which beside nothing visible.

    Frames that the user names are filled as they are named.
    """
    if entries.frames is not None:
        return np.zeros_like(asked), np.zeros_like(asked)
    patterns = ((), entries.channels)
    counted = np.any([match_channels(recording, one, results) for one in patterns], axis=0)
    anything = np.asarray(recording.visible[:, counted].any(axis=1))
    blank = asked & mask_ends(anything[:, np.newaxis])
    at_ends = asked & mask_ends(recording.visible) & ~blank
    return at_ends & (not entries.fill_ends), blank


def _mark_frames(recording: Recording, frames: tuple[int, int]) -> Mask:
    first, stop = frames
    n_frames = len(recording.times)
    if not 0 <= first < stop <= n_frames:
        raise UsageError(
            f"{recording.name}: expected --frames within 0:{n_frames}, the first before the last, "
            f"got {first}:{stop}"
        )
    rows = np.zeros(recording.values.shape, dtype=bool)
    rows[first:stop] = True
    return rows


def measure_gap(recording: Recording, gap: Gap) -> float:
    """Return how long a gap is: its frames times the mean distance of frames within and beside."""
    first, last = max(gap.start - 1, 0), min(gap.stop, len(recording.times) - 1)
    span = float(recording.times[last] - recording.times[first])
    return len(gap) * span / max(last - first, 1)


def _find_incomplete(recording: Recording, asked: Mask) -> tuple[str, ...]:
    """Return the channels with hidden entries of which none is asked for."""
    return _name_channels(recording, ~recording.visible.all(axis=0) & ~asked.any(axis=0))


def _name_channels(recording: Recording, which: ArrayLike) -> tuple[str, ...]:
    return tuple(recording.channels[k] for k in np.flatnonzero(which))
