"""The page of a filled file, as the values that `mocapbench.reports` draws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.filled_file import FilledFile
from mocapbench.benchmark.filling.gaps import Gap, find_gaps
from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.benchmark.filling.messages import (
    describe_choice,
    describe_fill,
    list_remarks,
)
from mocapbench.benchmark.filling.requests.request import FillRequest
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


def compose_page(filled: FilledFile, command: str) -> FilledPage:
    """Return the page of a filled file, made by ``command``."""
    gaps, recording = filled.input_file.request.gaps, filled.recording
    jumps = find_jumps(recording, filled.input_file.request.target)
    shown = list(_choose_gaps(recording, gaps, jumps))
    choice = filled.choice
    ranking = choice.ranking if choice else None
    return FilledPage(
        file=filled.input_file.path.name,
        headline=describe_fill(filled),
        verdict=describe_choice(filled),
        remarks=tuple(list_remarks(filled)),
        curves=tuple(_cut_curves(filled, recording, shown)),
        caption=_describe_gaps(gaps, shown),
        motion=_draw_motion(filled, recording, max(gaps, key=len)),
        units=_list_units(filled.input_file.request, choice.rmse) if choice else (),
        n_gaps=ranking.n_gaps if ranking else 0,
        errors={model: ranking.means[model] for model in ranking.order} if ranking else {},
        rmse=choice.rmse if choice else {},
        seconds=choice.seconds if choice else {},
        notes=_note_models(choice, filled.model) if choice else {},
        left_out=tuple(_list_left_out(choice)) if choice else (),
        command=command,
    )


def _list_units(request: FillRequest, rmse: Mapping[str, Mapping[str, float]]) -> tuple[str, ...]:
    """Return the units of the filled channels of which models have errors, in order."""
    channels = np.flatnonzero(request.target.any(axis=0))
    held_out = set().union(*rmse.values())
    units = dict.fromkeys(request.given.units[channel] for channel in channels)
    return tuple(unit for unit in units if unit in held_out)


def _note_models(choice: Choice, chosen: str) -> dict[str, str]:
    """Return what is to be said of each ranked model beside its errors."""
    ranking = choice.ranking
    notes = {}
    for model in ranking.order:
        is_chosen = "chosen" if model == chosen else ""
        alike = f"lead of {ranking.order[0]} may be chance" if model in ranking.rivals else ""
        windows = "fitted to windows" if choice.n_windows[model] else ""
        notes[model] = ", ".join(filter(None, (is_chosen, alike, windows)))
    return notes


def _list_left_out(choice: Choice) -> Iterator[tuple[str, str]]:
    """Yield the models without a rank, each with the reason."""
    for one in choice.left_out:
        n_filled = len(one.predictions)
        filled = f"{format_count(n_filled, 'hold-out')} filled; " if n_filled else ""
        yield one.model, f"{filled}{one.failure}"


def _choose_gaps(
    recording: Recording, gaps: Sequence[Gap], jumps: pd.DataFrame
) -> Iterator[tuple[Gap, int]]:
    """Yield gaps, each with its channels that jump at its edges, then those that move most.

    The gap with the worst jump and the longest are among them, and others at even distances.
    """
    per_gap = min(_CHANNELS_PER_GAP, max(len(gap.channels) for gap in gaps))
    count = min(len(gaps), _MOST_CURVES // per_gap)
    worst = [n for n, gap in enumerate(gaps) if len(_find_channels(jumps[:1], gap))]
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
    filled: FilledFile, recording: Recording, shown: Sequence[tuple[Gap, int]]
) -> Iterator[FilledCurve]:
    request = filled.input_file.request
    deviations = np.full(request.target.shape, np.nan)
    deviations[request.target] = filled.deviations
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


def _draw_motion(filled: FilledFile, recording: Recording, gap: Gap) -> Axes | None:
    """Return stick figures from before a gap until after it, where the file has a skeleton."""
    skeleton = filled.input_file.format.skeleton(filled.input_file.path)
    # Few frames beside it, so that figures are of filled frames, too.
    frames = _surround(gap, len(recording.times), _LEAST_MOTION)
    part = recording.frames(np.arange(frames.start, frames.stop))
    whole = len(part.times) > 1 and part.visible.all() and set(part.channels) >= _ROOT_PATH
    if skeleton is None or not whole:
        return None
    touched = filled.input_file.request.target[frames].any(axis=1)
    groups = np.where(touched, FILLED_FRAMES, GIVEN_FRAMES).tolist()
    return strip(part, JointAngles(skeleton), groups)
