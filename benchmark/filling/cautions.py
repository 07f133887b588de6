"""What makes the entries that were filled in doubtful, as the page and the terminal say it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.filling.edges import jumps
from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.requests.names import marker_names
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.benchmark.filling.requests.zeros import zeros_caution

__all__ = ["cautions"]

SLOW = 0.5
"""Seconds between frames from which on times are probably not in seconds."""
_NAMED = 4
"""Channels or markers that a caution names at most."""
_FEW = 10
"""Visible frames of a channel below which nothing can be learnt from it."""


def cautions(filled: Filled) -> Iterator[str]:
    """Yield that little is visible, that models extrapolate or jump, and that numbers are odd."""
    yield from _few_visible(filled)
    yield from _visible_nowhere(filled)
    yield from _at_the_ends(filled.source.request)
    yield from _warn_of_replaced_values(filled.source.request)
    yield from _jumps(filled)
    yield from _slow(filled)
    yield from filter(None, [zeros_caution(filled.source.request.given)])


def _few_visible(filled: Filled) -> Iterator[str]:
    given, target = filled.source.request.given, filled.source.request.target
    filling = target.any(axis=0)
    counts = given.visible[:, filling].sum(axis=0)
    least = int(counts.min())
    if least < _FEW and not filled.source.train:
        channel = np.array(given.channels)[filling][counts.argmin()]
        are = "is" if least == 1 else "are"
        yield (
            f"Of {channel}, only {format_count(least, 'frame')} {are} visible, too few to learn "
            "from: trust neither what was filled in nor any bands, or name similar recordings with "
            "--train."
        )


def _visible_nowhere(filled: Filled) -> Iterator[str]:
    given, target = filled.source.request.given, filled.source.request.target
    lost = np.flatnonzero(target.any(axis=0) & ~given.visible.any(axis=0))
    train = filled.source.train
    if not len(lost) or not train:
        return
    names = join_names([given.channels[channel] for channel in lost], _NAMED)
    caution = (
        f"Of {names}, nothing is visible in the file: no trial tells how well {filled.model} fills "
        "that."
    )
    if filled.choice and len(train) > 1 and filled.model != "best-of":
        caution += " --model best-of weighs models by how they fill it in the files of --train."
    yield caution


def _warn_of_replaced_values(request: FillRequest) -> Iterator[str]:
    if request.replaced:
        have = "entry that was filled has" if request.replaced == 1 else "filled entries have"
        yield f"{request.replaced} {have} a value in the file, which the filled one replaces."


def _at_the_ends(request: FillRequest) -> Iterator[str]:
    """Yield how many gaps have frames on one side only, and of which channels they are."""
    n_frames = len(request.given.times)
    ends = [gap for gap in request.gaps if (gap.start == 0) != (gap.stop == n_frames)]
    if not ends:
        return
    places = sorted({channel for gap in ends for channel in gap.channels})
    names = join_names(marker_names([request.given.channels[place] for place in places]), _NAMED)
    are = "is" if len(ends) == 1 else "are"
    yield (
        f"{format_count(len(ends), 'gap')} {are} at the beginning or the end of the recording, "
        f"where frames are visible on one side only ({names}): errors are larger there."
    )


def _jumps(filled: Filled) -> Iterator[str]:
    recording = filled.recording
    found = jumps(recording, filled.source.request.target)
    if found:
        frame, channel, size, largest = found[0]
        unit = f" {recording.units[channel]}".rstrip()
        yield (
            f"At {format_count(len(found), 'edge')} of gaps, a channel jumps further than between "
            f"any two visible frames: {recording.channels[channel]} by {size:.3g}{unit} at frame "
            f"{frame}, elsewhere by at most {largest:.3g}{unit}. Look at its "
            "curve before you use these entries."
        )


def _slow(filled: Filled) -> Iterator[str]:
    times = filled.source.request.given.times
    interval = (times[-1] - times[0]) / max(len(times) - 1, 1)
    if interval > SLOW:
        yield (
            f"Frames are {interval:.3g} s apart, which is long for motion: if the file's times are "
            "in milliseconds, divide them by 1000."
        )
