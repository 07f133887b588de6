"""What the page and the terminal say of a filled file: what was done, left, and is doubtful."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.errors import first_of
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.ranking import Ranking
from mocapbench.benchmark.filling.filled_file import FilledFile
from mocapbench.benchmark.filling.gaps import count_entries, mask_ends, mask_gaps
from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.benchmark.filling.requests.names import name_hidden_markers, name_markers
from mocapbench.benchmark.filling.requests.request import FillRequest

__all__ = ["describe_choice", "describe_fill", "list_remarks"]

_NAMED = 4
"""Models, channels or markers that a remark names at most."""
SLOW = 0.5
"""Seconds between frames from which on times are probably not in seconds."""
_FEW = 10
"""Visible frames of a channel below which nothing can be learnt from it."""


def describe_fill(filled: FilledFile) -> str:
    """Return which model filled how much, and how much is open at the ends."""
    request = filled.input_file.request
    entries = format_count(int(request.target.sum()), "entry", "entries")
    did = f"{filled.model} filled {entries} in {format_count(len(request.gaps), 'gap')}"
    n_open = count_entries((*request.open_ends, *request.blank_ends))
    return f"{did}, and left {n_open} open at the ends." if n_open else f"{did}."


def describe_choice(filled: FilledFile) -> str:
    """Return by how much the model leads in held-out gaps, and how good its intervals are there."""
    if filled.uncompared:
        return (
            "Nothing could be compared, since no model filled a held-out gap within its part of "
            "the budget: raise --budget to choose among models."
        )
    if filled.choice is None:
        named = "The model was named, so no held-out gap tells how much its intervals hold."
        return "" if filled.prediction.variance is None else named
    return f"{_describe_lead(filled.choice)} {_describe_intervals(filled)}".strip()


def _describe_intervals(filled: FilledFile) -> str:
    """Return what the intervals of the choice hold, if it has any and has filled the file."""
    choice = filled.choice
    if choice is None or filled.failed or filled.model not in choice.with_intervals:
        return ""
    if not choice.in_intervals:
        return (
            "There was no time to check its intervals in held-out gaps: raise --budget to see how "
            "much they hold."
        )
    inside = np.concatenate(choice.in_intervals)
    hidden = format_count(len(inside), "hidden entry", "hidden entries")
    gaps = format_count(len(choice.in_intervals), "held-out gap")
    return f"Its 95 % intervals hold {100 * inside.mean():.0f} % of {hidden} in {gaps}."


def _describe_lead(choice: Choice) -> str:
    ranking, gaps = choice.ranking, _count_gaps(choice.ranking)
    if len(ranking.order) == 1:
        return f"No other model could be compared with it, over {gaps}."
    if not ranking.tested:
        return f"It did best in {gaps}, too few to tell whether that is chance."
    if len(ranking.sharing) == 1:
        return f"Its lead over {ranking.order[1]} is more than chance, over {gaps}."
    if not ranking.rivals:
        return f"It leads by far, but gaps differ too much for a test, over {gaps}."
    rivals = join_names(ranking.rivals, len(ranking.rivals))
    return f"Its lead over {rivals} may be chance, over {gaps}."


def _count_gaps(ranking: Ranking) -> str:
    gaps = format_count(ranking.n_gaps, "held-out gap")
    positions = format_count(ranking.n_positions, "independent position")
    return f"{gaps} at {positions}" if ranking.n_positions < ranking.n_gaps else gaps


def list_remarks(filled: FilledFile) -> Iterator[str]:
    """Yield what was cut, left open or shortened, what failed, and what makes entries doubtful."""
    for model, failure in filled.failed:
        yield f"{model} did better in held-out gaps, but did not fill the file: {failure}."
    if filled.n_windows:
        yield (
            f"{filled.model} does not take a recording of this length: it was fitted to "
            f"{_count_windows(filled.n_windows)}."
        )
    yield from _remark_on_hidden(filled.input_file.request)
    if filled.choice:
        yield from _remark_on_choice(filled, filled.choice)
    if filled.prediction.variance is None:
        none = f"{filled.model} has no predictive distribution, so there are no intervals."
        yield f"{none} {_name_one_with_intervals(filled)}".strip()
    yield from _warn_of_doubts(filled)


def _count_windows(count: int) -> str:
    one = "a window around the gap"
    return one if count == 1 else f"{count} windows around the gaps, each on its own"


def _remark_on_choice(filled: FilledFile, choice: Choice) -> Iterator[str]:
    """Yield how comparable the held-out gaps are, and which models had no time."""
    if choice.share < 1.0:
        yield (
            "No visible stretch is long enough for copies of all gaps: held-out gaps are down to "
            f"{100 * choice.share:.3g} % as long as the real ones, in which errors are larger."
        )
    if choice.unused and not filled.failed:
        yield (
            f"{filled.model} had no time for {format_count(choice.unused, 'more hold-out')} that "
            "others filled: all models are compared without them."
        )
    timed_out = [one.model for one in choice.left_out if one.timed_out]
    if timed_out:
        yield (
            f"Time was up before {join_names(timed_out, _NAMED)} had filled the held-out gaps that "
            "the others filled: a larger --budget may find a better model among them."
        )


def _name_one_with_intervals(filled: FilledFile) -> str:
    """Return the best model with intervals that held-out gaps cannot tell from the choice."""
    if filled.choice is None or filled.failed:
        return ""
    choice = filled.choice
    alike = [model for model in choice.ranking.rivals if model in choice.with_intervals]
    if not alike:
        return ""
    return f"Held-out gaps do not tell it apart from {alike[0]}, which has intervals."


def _remark_on_hidden(request: FillRequest) -> Iterator[str]:
    """Yield how many gaps were left open, and how many entries stay hidden for other reasons."""
    yield from _remark_on_ends(request)
    if request.left_open:
        were = format_count(len(request.left_open), "longer gap was", "longer gaps were")
        yield f"{were} left open."
    if request.unlabelled:
        yield _describe_unlabelled(name_markers(request.unlabelled))
    if request.outputs:
        yield _describe_outputs(name_markers(request.outputs))
    if request.unknown:
        yield _describe_unknown(name_markers(request.unknown))
    told = [*request.unlabelled, *request.outputs, *request.unknown]
    others = ~np.isin(request.given.channels, told)
    ends = mask_gaps((*request.open_ends, *request.blank_ends), request.target.shape)
    rest = int((~request.given.visible & ~request.target & ~ends)[:, others].sum())
    if rest:
        stay = format_count(rest, "hidden entry stays", "hidden entries stay")
        yield f"{stay} hidden, since {'it was' if rest == 1 else 'they were'} not to be filled."


def _remark_on_ends(request: FillRequest) -> Iterator[str]:
    """Yield what stays open before it is first visible or after it is last visible."""
    if request.open_ends:
        markers = name_hidden_markers(request.given.channels, request.open_ends)
        entries = format_count(count_entries(request.open_ends), "entry", "entries")
        stay, them = ("stays", "it") if entries == "1 entry" else ("stay", "them")
        yield (
            f"Of {join_names(markers, _NAMED)}, {entries} before the first visible one or after "
            f"the last {stay} open: --ends fill fills {them}, with larger errors."
        )
    if request.blank_ends:
        frames = format_count(sum(map(len, request.blank_ends)), "frame")
        yield f"Nothing is visible in {frames} at the beginning or the end, which stay open."


def _describe_unlabelled(markers: Sequence[str]) -> str:
    stay, them = ("stays as it is", "it") if len(markers) == 1 else ("stay as they are", "them")
    return (
        f"{format_count(len(markers), 'unlabelled marker')} ({first_of(markers, _NAMED)}) {stay}: "
        f"name {them} with --channels to fill {them}."
    )


def _describe_outputs(points: Sequence[str]) -> str:
    count = format_count(
        len(points), "result of a model of the body", "results of a model of the body"
    )
    stay, them = ("stays as it is", "it") if len(points) == 1 else ("stay as they are", "them")
    return (
        f"{count} ({first_of(points, _NAMED)}) {stay}, as the model gives {them} anew from filled "
        f"markers: name {them} with --channels to fill {them}."
    )


def _describe_unknown(names: Sequence[str]) -> str:
    stay, them = (
        ("It stays as it is", "it") if len(names) == 1 else ("They stay as they are", "them")
    )
    return (
        f"Nothing is visible that {join_names(names, _NAMED)} could be filled from. {stay}: name "
        f"files that have {them} with --train."
    )


def _warn_of_doubts(filled: FilledFile) -> Iterator[str]:
    """Yield that little is visible, that models extrapolate or jump, and that numbers are odd."""
    request = filled.input_file.request
    yield from _warn_of_few_visible(filled)
    yield from _warn_of_lost_channels(filled)
    yield from _warn_of_ends(request)
    yield from _warn_of_replaced_values(request)
    yield from _warn_of_jumps(filled)
    yield from _warn_of_long_intervals(request)
    yield from filled.input_file.remarks


def _warn_of_few_visible(filled: FilledFile) -> Iterator[str]:
    given, target = filled.input_file.request.given, filled.input_file.request.target
    filling = target.any(axis=0)
    counts = given.visible[:, filling].sum(axis=0)
    least = int(counts.min())
    if least < _FEW and not filled.input_file.train:
        channel = np.array(given.channels)[filling][counts.argmin()]
        are = "is" if least == 1 else "are"
        yield (
            f"Of {channel}, only {format_count(least, 'frame')} {are} visible, too few to learn "
            "from: trust neither the filled values nor their intervals, or name similar "
            "recordings with --train."
        )


def _warn_of_lost_channels(filled: FilledFile) -> Iterator[str]:
    given, target = filled.input_file.request.given, filled.input_file.request.target
    lost = np.flatnonzero(target.any(axis=0) & ~given.visible.any(axis=0))
    train = filled.input_file.train
    if not len(lost) or not train:
        return
    names = join_names([given.channels[channel] for channel in lost], _NAMED)
    caution = (
        f"Of {names}, nothing is visible in the file: no held-out gap tells how well "
        f"{filled.model} fills that."
    )
    if filled.choice and len(train) > 1 and filled.model != "best-of":
        caution += " --model best-of weighs models by how they fill it in the files of --train."
    yield caution


def _warn_of_replaced_values(request: FillRequest) -> Iterator[str]:
    if request.replaced:
        have = "entry that was filled has" if request.replaced == 1 else "filled entries have"
        yield f"{request.replaced} {have} a value in the file, which the filled one replaces."


def _warn_of_ends(request: FillRequest) -> Iterator[str]:
    """Yield how many gaps have frames on one side only, and of which channels they are."""
    at_ends = mask_ends(request.given.visible)
    ends = [gap for gap in request.gaps if at_ends[gap.start, list(gap.channels)].any()]
    if not ends:
        return
    names = join_names(name_hidden_markers(request.given.channels, ends), _NAMED)
    are = "is" if len(ends) == 1 else "are"
    yield (
        f"{format_count(len(ends), 'gap')} {are} at the beginning or the end of the recording, "
        f"where frames are visible on one side only ({names}): errors are larger there."
    )


def _warn_of_jumps(filled: FilledFile) -> Iterator[str]:
    recording = filled.recording
    jumps = find_jumps(recording, filled.input_file.request.target)
    if len(jumps):
        frame, channel = (int(jumps[name].iloc[0]) for name in ("frame", "channel"))
        size, largest = (float(jumps[name].iloc[0]) for name in ("size", "largest"))
        unit = f" {recording.units[channel]}".rstrip()
        yield (
            f"At {format_count(len(jumps), 'edge')} of gaps, a channel jumps further than between "
            f"any two visible frames: {recording.channels[channel]} by {size:.3g}{unit} at frame "
            f"{frame}, elsewhere by at most {largest:.3g}{unit}. Look at its "
            "curve before you use these entries."
        )


def _warn_of_long_intervals(request: FillRequest) -> Iterator[str]:
    times = request.given.times
    interval = (times[-1] - times[0]) / max(len(times) - 1, 1)
    if interval > SLOW:
        yield (
            f"Frames are {interval:.3g} s apart, which is long for motion: if the file's times are "
            "in milliseconds, divide them by 1000."
        )
