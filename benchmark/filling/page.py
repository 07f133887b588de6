"""The page of a filled file, as the values that `mocapbench.reports` draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.filling.fill import Filled
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.remarks import headline, left_out, ranked, remarks, units, verdict
from mocapbench.datasets import root_differences
from mocapbench.reports import FilledCurve, FilledPage, Panel

__all__ = ["page_of"]

_MOST_CURVES, _CHANNELS_PER_GAP = 16, 4
_BESIDE = 1.0
"""How much of the recording is shown on each side of a gap, relative to its length."""
_LEAST_BESIDE = 15
_ROOT_PATH = frozenset({"root.tx", "root.ty", "root.tz"})


def page_of(filled: Filled, command: str) -> FilledPage:
    """Return the page of a filled file, made by ``command``."""
    gaps = filled.source.request.gaps
    shown = list(_shown(filled, gaps))
    choice = filled.choice
    return FilledPage(
        file=filled.source.path.name,
        headline=headline(filled),
        verdict=verdict(filled),
        remarks=tuple(remarks(filled)),
        curves=tuple(_curve(filled, gap, channel) for gap, channel in shown),
        caption=_caption(filled, shown),
        motion=_motion(filled, max(gaps, key=len)),
        units=units(filled),
        n=choice.ranking.n if choice else 0,
        ranking=tuple(ranked(filled)),
        left_out=tuple(left_out(filled)),
        command=command,
    )


def _shown(filled: Filled, gaps: Sequence[Gap]) -> Iterator[tuple[Gap, int]]:
    """Yield gaps at even distances, each with its channels that move most."""
    per_gap = min(_CHANNELS_PER_GAP, max(len(gap.channels) for gap in gaps))
    places = np.linspace(0, len(gaps) - 1, min(len(gaps), _MOST_CURVES // per_gap))
    values = filled.recording.values
    for gap in (gaps[place] for place in np.unique(places.round().astype(int))):
        moved = np.ptp(values[gap.start : gap.stop, list(gap.channels)], axis=0)
        for place in np.argsort(-moved, kind="stable")[:per_gap]:
            yield gap, gap.channels[place]


def _curve(filled: Filled, gap: Gap, channel: int) -> FilledCurve:
    request = filled.source.request
    frames = _around(gap, len(request.given.times))
    deviations = np.full(request.target.shape, np.nan)
    deviations[request.target] = filled.deviations
    target, times = request.target[frames, channel], request.given.times
    last = len(times) - 1
    return FilledCurve(
        request.given.channels[channel],
        request.given.units[channel],
        times[frames],
        request.given.values[frames, channel],
        np.where(target, filled.recording.values[frames, channel], np.nan),
        deviations[frames, channel],
        tuple(
            (float(times[max(g.start - 1, 0)]), float(times[min(g.stop, last)]))
            for g in request.gaps
            if channel in g.channels and g.start < frames.stop and g.stop > frames.start
        ),
    )


def _around(gap: Gap, n_frames: int) -> slice:
    """Return the frames of a gap and those beside it."""
    beside = max(int(_BESIDE * len(gap)), _LEAST_BESIDE)
    return slice(max(gap.start - beside, 0), min(gap.stop + beside, n_frames))


def _caption(filled: Filled, shown: Sequence[tuple[Gap, int]]) -> str:
    request = filled.source.request
    n_gaps, n_shown = len(request.gaps), len({gap for gap, _ in shown})
    which = "The only gap" if n_gaps == 1 else f"{n_shown} of {n_gaps} gaps"
    most = max((len(gap.channels) for gap, _ in shown), default=0)
    per_gap = min(_CHANNELS_PER_GAP, most)
    channels = ", with the channels that move most in it" if most > per_gap else ""
    return f"{which}{channels}. The table beside this page has every filled entry."


def _motion(filled: Filled, gap: Gap) -> Panel | None:
    """Return stick figures from before a gap until after it, where the file has a skeleton."""
    skeleton = filled.source.format.skeleton(filled.source.path)
    recording = filled.recording
    frames = _around(gap, len(recording.times))
    part = recording.frames(np.arange(frames.start, frames.stop))
    if skeleton is None or not part.visible.all() or not set(part.channels) >= _ROOT_PATH:
        return None
    return strip(root_differences(part), skeleton, "filled")
