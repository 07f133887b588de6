"""The page of a filled file, as the values that `mocapbench.reports` draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.faults import describe_faults, tabulate_faults
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_table import (
    describe_gaps,
    describe_options,
    sort_by_caution,
)
from mocapbench.benchmark.filling.gaps import Gap, find_gaps
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.benchmark.filling.messages import (
    describe_choice,
    describe_fill,
    list_remarks,
)
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.datasets import Mask, Recording
from mocapbench.reports import Axes, FilledCurve, FilledPage
from mocapbench.reports.filling.curves import FILLED_FRAMES, GIVEN_FRAMES

__all__ = ["compose_page"]

_MOST_CURVES, _CHANNELS_PER_GAP = 16, 4
_BESIDE = 1.0
"""How much of the recording is shown on each side of a gap, relative to its length."""
_LEAST_BESIDE, _LEAST_MOTION = 15, 3
_ROOT_PATH = frozenset({"root.tx", "root.ty", "root.tz"})


def compose_page(
    input_file: InputFile, filled: FilledRecording, gaps_table: pd.DataFrame, command: str
) -> FilledPage:
    """Return the page of a filled file, made by ``command``, with a table of its gaps."""
    gaps, recording = filled.request.gaps, filled.recording
    jumps = find_jumps(recording, filled.request.target)
    shown = list(_choose_gaps(recording, gaps, jumps))
    choice, table = filled.choice, sort_by_caution(gaps_table)
    return FilledPage(
        file=input_file.path.name,
        headline=describe_fill(filled),
        verdict=tuple(describe_choice(filled)),
        remarks=(
            *list_remarks(filled),
            *describe_faults(input_file.faults),
            *input_file.remarks,
        ),
        faults=tuple(tabulate_faults(input_file.faults)),
        curves=tuple(_cut_curves(filled, recording, shown)),
        caption=_describe_gaps(gaps, shown),
        gaps=describe_gaps(table),
        options=describe_options(filled, table),
        motion=_draw_motion(input_file, filled, recording, max(gaps, key=len)),
        rankings=_tabulate_rankings(filled, choice) if choice else {},
        left_out=tuple(_list_left_out(choice)) if choice else (),
        command=command,
    )


def _tabulate_rankings(filled: FilledRecording, choice: Choice) -> dict[str, pd.DataFrame]:
    """Return a table of the ranked models for each kind of gap."""
    return {
        f"{kind}: {format_count(ranking.n_gaps, 'held-out gap')}": pd.DataFrame(
            {
                "model": ranking.order,
                f"error, {kind.unit}".rstrip(", "): [ranking.means[m] for m in ranking.order],
                "": [_note_model(filled, choice, kind, model) for model in ranking.order],
            }
        )
        for kind, ranking in choice.rankings.items()
    }


def _note_model(filled: FilledRecording, choice: Choice, kind: Kind, model: str) -> str:
    """Return what is to be said of a ranked model beside its error."""
    ranking = choice.rankings[kind]
    first, means = ranking.order[0], ranking.means
    lead = (
        f"lead of {first} may be chance"
        if means[model] >= means[first]
        else "less, maybe by chance"
    )
    of_kind = filled.kinds == filled.all_kinds.index(kind)
    n_windows = {one.model: one.n_windows for one in choice.contenders}
    notes = (
        "chosen" if model in filled.models[of_kind] else "",
        lead if model in ranking.rivals else "",
        "fitted to windows" if n_windows[model] else "",
    )
    return ", ".join(filter(None, notes))


def _list_left_out(choice: Choice) -> Iterator[tuple[str, str]]:
    """Yield the models without a rank, each with the reason."""
    ranked = {model for ranking in choice.rankings.values() for model in ranking.order}
    for one in choice.contenders:
        if one.model not in ranked:
            yield one.model, one.ending
    for model in choice.too_dear:
        yield model, "would take more work than --effort allows, to fill the file"


def _choose_gaps(
    recording: Recording, gaps: Sequence[Gap], jumps: pd.DataFrame
) -> Iterator[tuple[Gap, int]]:
    """Yield gaps, each with its channels that jump at its edges, then those that move most.

    The gap with the worst jump and the longest are among them, and others at even distances.
    """
    per_gap = min(_CHANNELS_PER_GAP, max(len(gap.channels) for gap in gaps))
    count = min(len(gaps), _MOST_CURVES // per_gap)
    worst = [
        n
        for frame, channel in zip(jumps["frame"][:1], jumps["channel"][:1], strict=True)
        for n, gap in enumerate(gaps)
        if gap.start <= frame < gap.stop and channel in gap.channels
    ]
    longest = max(range(len(gaps)), key=lambda n: len(gaps[n]))
    named = {*worst, longest}
    n_even = count - len(named) if count < len(gaps) else count
    even = np.linspace(0, len(gaps) - 1, n_even).round().astype(int).tolist()
    for gap in (gaps[n] for n in sorted({*named, *even})):
        moved = np.ptp(recording.values[gap.start : gap.stop, list(gap.channels)], axis=0)
        most = [gap.channels[k] for k in np.argsort(-moved, kind="stable")]
        for channel in [*dict.fromkeys([*_find_channels(jumps, gap), *most])][:per_gap]:
            yield gap, channel


def _find_channels(jumps: pd.DataFrame, gap: Gap) -> list[int]:
    """Return the channels that jump at the edges of a gap."""
    in_time = jumps["frame"].between(gap.start, gap.stop - 1)
    channels: list[int] = jumps["channel"][in_time & jumps["channel"].isin(gap.channels)].tolist()
    return channels


def _cut_curves(
    filled: FilledRecording, recording: Recording, shown: Sequence[tuple[Gap, int]]
) -> Iterator[FilledCurve]:
    request = filled.request
    deviations = np.full(request.target.shape, np.nan)
    deviations[request.target] = filled.std
    for gap, channel in shown:
        frames = _surround(gap, len(recording.times), _LEAST_BESIDE)
        yield FilledCurve(
            recording.channels[channel],
            recording.units[channel],
            recording.times[frames],
            request.given.values[frames, channel],
            np.where(request.target[frames, channel], recording.values[frames, channel], np.nan),
            deviations[frames, channel],
            tuple(_find_spans(recording, request.target[frames, channel], frames)),
        )


def _find_spans(recording: Recording, filled: Mask, frames: slice) -> Iterator[tuple[float, float]]:
    """Yield from when until when a channel (n,) was filled, up to the frames beside."""
    last = len(recording.times) - 1
    for gap in find_gaps(filled[:, None]):
        first, stop = frames.start + gap.start - 1, frames.start + gap.stop
        yield float(recording.times[max(first, 0)]), float(recording.times[min(stop, last)])


def _surround(gap: Gap, n_frames: int, least: int) -> slice:
    """Return the frames of a gap and those beside it, at least so many on each side."""
    beside = max(int(_BESIDE * len(gap)), least)
    return slice(max(gap.start - beside, 0), min(gap.stop + beside, n_frames))


def _describe_gaps(gaps: Sequence[Gap], shown: Sequence[tuple[Gap, int]]) -> str:
    n_shown = len({gap for gap, _ in shown})
    some = f"{n_shown} of {len(gaps)} gaps, the longest among them"
    which = "The only gap" if len(gaps) == 1 else some if n_shown < len(gaps) else "All gaps"
    most = max(len(gap.channels) for gap, _ in shown)
    them = "it" if len(gaps) == 1 else "each"
    channels = (
        f", with channels that jump at an edge or move most in {them}"
        if most > _CHANNELS_PER_GAP
        else ""
    )
    return f"{which}{channels}. The table beside this page has every filled entry."


def _draw_motion(
    input_file: InputFile, filled: FilledRecording, recording: Recording, gap: Gap
) -> Axes | None:
    """Return stick figures from before a gap until after it, where the file has a skeleton."""
    skeleton = input_file.format.skeleton(input_file.path)
    # Few frames beside it, so that figures are of filled frames, too.
    frames = _surround(gap, len(recording.times), _LEAST_MOTION)
    part = recording.frames(np.arange(frames.start, frames.stop))
    whole = len(part.times) > 1 and part.visible.all() and set(part.channels) >= _ROOT_PATH
    if skeleton is None or not whole:
        return None
    touched = filled.request.target[frames].any(axis=1)
    groups = np.where(touched, FILLED_FRAMES, GIVEN_FRAMES).tolist()
    return strip(part, JointAngles(skeleton), groups)
