"""The page of a filled file, as the values that `mocapbench.reports` draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.filling.edges import Jump, jumps
from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.gaps import Gap, gaps_of
from mocapbench.benchmark.filling.ranking_table import left_out, ranked, units
from mocapbench.benchmark.filling.wording import headline, remarks, verdict
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.datasets import Mask, Recording
from mocapbench.reports import FilledCurve, FilledPage, Panel
from mocapbench.reports.filling.values import FILLED_FRAMES, GIVEN_FRAMES

__all__ = ["page_of"]

_MOST_CURVES, _CHANNELS_PER_GAP = 16, 4
_BESIDE = 1.0
"""How much of the recording is shown on each side of a gap, relative to its length."""
_LEAST_BESIDE, _LEAST_MOTION = 15, 3
_ROOT_PATH = frozenset({"root.tx", "root.ty", "root.tz"})


def page_of(filled: Filled, command: str) -> FilledPage:
    """Return the page of a filled file, made by ``command``."""
    gaps, recording = filled.source.request.gaps, filled.recording
    shown = list(_choose_gaps(recording, gaps, jumps(recording, filled.source.request.target)))
    choice = filled.choice
    return FilledPage(
        file=filled.source.path.name,
        headline=headline(filled),
        verdict=verdict(filled),
        remarks=tuple(remarks(filled)),
        curves=tuple(_curves(filled, recording, shown)),
        caption=_caption(gaps, shown),
        motion=_motion(filled, recording, max(gaps, key=len)),
        units=units(filled),
        n=choice.ranking.n if choice else 0,
        ranking=tuple(ranked(filled)),
        left_out=tuple(left_out(filled)),
        command=command,
    )


def _choose_gaps(
    recording: Recording, gaps: Sequence[Gap], found: Sequence[Jump]
) -> Iterator[tuple[Gap, int]]:
    """Yield gaps, each with its channels that jump at its edges, then those that move most.

    The gap with the worst jump and the longest are among them, and others at even distances.
    """
    per_gap = min(_CHANNELS_PER_GAP, max(len(gap.channels) for gap in gaps))
    count = min(len(gaps), _MOST_CURVES // per_gap)
    worst = [n for jump in found[:1] for n, gap in enumerate(gaps) if _is_in(jump, gap)]
    longest = max(range(len(gaps)), key=lambda n: len(gaps[n]))
    named = {*worst, longest}
    n_even = count - len(named) if count < len(gaps) else count
    even = np.linspace(0, len(gaps) - 1, n_even).round().astype(int).tolist()
    for gap in (gaps[n] for n in sorted({*named, *even})):
        moved = np.ptp(recording.values[gap.start : gap.stop, list(gap.channels)], axis=0)
        most = [gap.channels[place] for place in np.argsort(-moved, kind="stable")]
        jumping = [jump.channel for jump in found if _is_in(jump, gap)]
        for channel in [*dict.fromkeys([*jumping, *most])][:per_gap]:
            yield gap, channel


def _is_in(jump: Jump, gap: Gap) -> bool:
    return jump.channel in gap.channels and gap.start <= jump.frame < gap.stop


def _curves(
    filled: Filled, recording: Recording, shown: Sequence[tuple[Gap, int]]
) -> Iterator[FilledCurve]:
    request = filled.source.request
    deviations = np.full(request.target.shape, np.nan)
    deviations[request.target] = filled.deviations
    for gap, channel in shown:
        frames = _around(gap, len(recording.times), _LEAST_BESIDE)
        yield FilledCurve(
            recording.channels[channel],
            recording.units[channel],
            recording.times[frames],
            request.given.values[frames, channel],
            np.where(request.target[frames, channel], recording.values[frames, channel], np.nan),
            deviations[frames, channel],
            tuple(_spans(recording, request.target[frames, channel], frames)),
        )


def _spans(recording: Recording, filled: Mask, frames: slice) -> Iterator[tuple[float, float]]:
    """Yield from when until when a channel (n,) was filled, up to the frames beside."""
    last = len(recording.times) - 1
    for gap in gaps_of(filled[:, None]):
        first, stop = frames.start + gap.start - 1, frames.start + gap.stop
        yield float(recording.times[max(first, 0)]), float(recording.times[min(stop, last)])


def _around(gap: Gap, n_frames: int, least: int) -> slice:
    """Return the frames of a gap and those beside it, at least so many on each side."""
    beside = max(int(_BESIDE * len(gap)), least)
    return slice(max(gap.start - beside, 0), min(gap.stop + beside, n_frames))


def _caption(gaps: Sequence[Gap], shown: Sequence[tuple[Gap, int]]) -> str:
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


def _motion(filled: Filled, recording: Recording, gap: Gap) -> Panel | None:
    """Return stick figures from before a gap until after it, where the file has a skeleton."""
    skeleton = filled.source.format.skeleton(filled.source.path)
    # Few frames beside it, so that figures are of filled frames, too.
    frames = _around(gap, len(recording.times), _LEAST_MOTION)
    part = recording.frames(np.arange(frames.start, frames.stop))
    whole = len(part.times) > 1 and part.visible.all() and set(part.channels) >= _ROOT_PATH
    if skeleton is None or not whole:
        return None
    touched = filled.source.request.target[frames].any(axis=1)
    groups = np.where(touched, FILLED_FRAMES, GIVEN_FRAMES).tolist()
    return strip(part, JointAngles(skeleton), groups)
