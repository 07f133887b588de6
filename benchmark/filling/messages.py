"""What the page and the terminal say of a filled file: what was done, left, and is doubtful."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.ranking import Ranking
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_cautions import FEW_VISIBLE
from mocapbench.benchmark.filling.gaps import count_entries, find_gaps, mask_ends, mask_gaps
from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.benchmark.filling.requests.names import name_hidden_markers, name_markers
from mocapbench.benchmark.filling.requests.request import FillRequest

__all__ = ["describe_choice", "describe_fill", "list_remarks"]

_NAMED = 4
"""Models, channels or markers that a remark names at most."""
SLOW = 0.5
"""Seconds between frames from which on times are probably not in seconds."""


def describe_fill(filled: FilledRecording) -> str:
    """Return which models filled how much, what is open at the ends, and what was not compared."""
    request = filled.request
    did = join_names([_count_filled(filled, model) for model in filled.used], len(filled.used))
    n_open = count_entries((*request.open_ends, *request.blank_ends))
    left = f", and left {n_open} open at the ends" if n_open else ""
    missing = _list_uncompared(filled.choice)
    lacks = f" Not compared: {join_names(missing, _NAMED)}." if missing else ""
    return f"{did}{left}.{lacks}"


def _count_filled(filled: FilledRecording, model: str) -> str:
    """Return how much a model filled."""
    mask = np.zeros(filled.request.target.shape, dtype=bool)
    mask[filled.request.target] = filled.models == model
    entries = format_count(int(mask.sum()), "entry", "entries")
    return f"{model} filled {entries} in {format_count(len(find_gaps(mask)), 'gap')}"


def _list_uncompared(choice: Choice | None) -> list[str]:
    """Return the models that are able, and have filled no held-out gap."""
    if choice is None:
        return []
    return [*(one.model for one in choice.contenders if not one.predictions), *choice.too_dear]


def describe_choice(filled: FilledRecording) -> Iterator[str]:
    """Yield for each kind of gap by how much a model leads, and how good its intervals are."""
    if filled.choice is None:
        if not np.isnan(filled.std).all():
            yield "The model was named, so no held-out gap tells how much its intervals hold."
        return
    lacks = bool(_list_uncompared(filled.choice))
    for kind, ranking in filled.choice.rankings.items():
        lead = _describe_lead(ranking, lacks)
        yield f"{kind}: {lead} {_describe_intervals(filled.choice, kind)}".strip()


def _describe_intervals(choice: Choice, kind: Kind) -> str:
    """Return what the intervals of the first model hold, if it has any."""
    model = choice.rankings[kind].order[0]
    if kind in choice.in_intervals:
        inside = choice.in_intervals[kind]
        hidden = format_count(len(inside), "hidden entry", "hidden entries")
        return f"Its 95 % intervals hold {100 * inside.mean():.0f} % of {hidden}."
    if model in choice.with_intervals:
        return "Its intervals were not checked: --effort high has the work for it."
    return ""


def _describe_lead(ranking: Ranking, lacks: bool) -> str:
    """Return by how much the first model leads; not by far where others were not compared."""
    first, *others = ranking.order
    gaps = _count_gaps(ranking)
    if not others:
        return f"{first} alone was compared to the end, over {gaps}."
    if ranking.least != first:
        return (
            f"{first} did best over all kinds of gaps together; that {ranking.least} did better in "
            f"{gaps} of this kind may be chance."
        )
    if not ranking.tested:
        return f"{first} did best in {gaps}, too few to tell whether that is chance."
    return f"{_describe_test(ranking, lacks)}, over {gaps}."


def _describe_test(ranking: Ranking, lacks: bool) -> str:
    """Return what the test says of the lead of the first model."""
    first, second = ranking.order[:2]
    if len(ranking.sharing) == 1:
        return f"{first} leads {second} by more than chance"
    if not ranking.rivals and lacks:
        return f"{first} errs least of those compared"
    if not ranking.rivals:
        return f"{first} leads by far, but gaps differ too much for a test"
    rivals = join_names(ranking.rivals, len(ranking.rivals))
    return f"The lead of {first} over {rivals} may be chance"


def _count_gaps(ranking: Ranking) -> str:
    gaps = format_count(ranking.n_gaps, "held-out gap")
    positions = format_count(ranking.n_positions, "independent position")
    return f"{gaps} at {positions}" if ranking.n_positions < ranking.n_gaps else gaps


def list_remarks(filled: FilledRecording) -> Iterator[str]:
    """Yield what was cut, left open or shortened, what failed, and what makes entries doubtful."""
    if filled.stopped:
        yield (
            f"This cannot be repeated elsewhere: {join_names(filled.stopped, _NAMED)} exceeded a "
            "limit of time or memory of this machine. Fill the file again when it is idle, or "
            "name a model."
        )
    for model, failure in filled.failed.items():
        yield f"{model} did better in held-out gaps, but did not fill the file: {failure}."
    for model in filled.used:
        if filled.n_windows[model]:
            yield (
                f"{model} does not take a recording of this length: it was fitted to "
                f"{_count_windows(filled.n_windows[model])}."
            )
    yield from _remark_on_hidden(filled.request)
    if filled.choice:
        yield from _remark_on_shorter_copies(filled.choice)
    yield from _remark_on_intervals(filled)
    yield from _warn_of_doubts(filled)


def _count_windows(count: int) -> str:
    one = "a window around the gap"
    return one if count == 1 else f"{count} windows around the gaps, each on its own"


def _remark_on_shorter_copies(choice: Choice) -> Iterator[str]:
    """Yield of which kinds there was no room for copies as long as the gaps."""
    for kind, share in choice.shares.items():
        if share < 1.0:
            yield (
                f"{kind}: no visible stretch is long enough for copies of all gaps. Held-out gaps "
                f"are down to {100 * share:.3g} % as long as the real ones, in which errors are "
                "larger."
            )


def _remark_on_intervals(filled: FilledRecording) -> Iterator[str]:
    """Yield which models that filled entries have no intervals, and which others do."""
    for model in filled.used:
        kinds = {filled.all_kinds[k] for k in filled.kinds[filled.models == model].tolist()}
        if np.isnan(filled.std[filled.models == model]).all():
            none = f"{model} has no predictive distribution, so there are no intervals."
            yield f"{none} {_name_one_with_intervals(filled.choice, kinds)}".strip()


def _name_one_with_intervals(choice: Choice | None, kinds: Collection[Kind]) -> str:
    """Return the best model with intervals that held-out gaps cannot tell from the choice."""
    if choice is None:
        return ""
    rankings = [choice.rankings[kind] for kind in sorted(kinds) if kind in choice.rankings]
    alike = [m for one in rankings for m in one.rivals if m in choice.with_intervals]
    if not alike:
        return ""
    return f"Held-out gaps do not tell it apart from {alike[0]}, which has intervals."


def _remark_on_hidden(request: FillRequest) -> Iterator[str]:
    """Yield how many gaps were left open, and how many entries stay hidden for other reasons."""
    yield from _remark_on_ends(request)
    if request.left_open:
        were = format_count(len(request.left_open), "longer gap was", "longer gaps were")
        yield f"{were} left open."
    if request.left_by_hand:
        were = format_count(len(request.left_by_hand), "gap was", "gaps were")
        names = name_hidden_markers(request.given.channels, request.left_by_hand)
        yield f"{were} left open by --leave or --only: {join_names(names, _NAMED)}."
    if request.unlabelled:
        yield _describe_unlabelled(name_markers(request.unlabelled))
    if request.outputs:
        yield _describe_outputs(name_markers(request.outputs))
    if request.unknown:
        yield _describe_unknown(name_markers(request.unknown))
    told = [*request.unlabelled, *request.outputs, *request.unknown]
    others = ~np.isin(request.given.channels, told)
    told_gaps = (*request.open_ends, *request.blank_ends, *request.left_by_hand)
    told_entries = mask_gaps(told_gaps, request.target.shape)
    rest = int((~request.given.visible & ~request.target & ~told_entries)[:, others].sum())
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
    count, names = format_count(len(markers), "unlabelled marker"), join_names(markers, _NAMED)
    return f"{count} ({names}) {stay}: name {them} with --channels to fill {them}."


def _describe_outputs(points: Sequence[str]) -> str:
    count = format_count(
        len(points), "result of a model of the body", "results of a model of the body"
    )
    stay, them = ("stays as it is", "it") if len(points) == 1 else ("stay as they are", "them")
    return (
        f"{count} ({join_names(points, _NAMED)}) {stay}, as the model gives {them} anew from "
        f"filled markers: name {them} with --channels to fill {them}."
    )


def _describe_unknown(names: Sequence[str]) -> str:
    stay, them = (
        ("It stays as it is", "it") if len(names) == 1 else ("They stay as they are", "them")
    )
    return (
        f"Nothing is visible that {join_names(names, _NAMED)} could be filled from. {stay}: name "
        f"files that have {them} with --train."
    )


def _warn_of_doubts(filled: FilledRecording) -> Iterator[str]:
    """Yield that little is visible, that models extrapolate or jump, and that numbers are odd."""
    request = filled.request
    yield from _warn_of_few_visible(filled)
    yield from _warn_of_lost_channels(filled)
    yield from _warn_of_ends(request)
    yield from _warn_of_replaced_values(request)
    yield from _warn_of_jumps(filled)
    yield from _warn_of_long_intervals(request)


def _warn_of_few_visible(filled: FilledRecording) -> Iterator[str]:
    given, target = filled.request.given, filled.request.target
    filling = target.any(axis=0)
    counts = given.visible[:, filling].sum(axis=0)
    least = int(counts.min())
    if least < FEW_VISIBLE and not filled.request.train:
        channel = np.array(given.channels)[filling][counts.argmin()]
        are = "is" if least == 1 else "are"
        yield (
            f"Of {channel}, only {format_count(least, 'frame')} {are} visible, too few to learn "
            "from: trust neither the filled values nor their intervals, or name similar "
            "recordings with --train."
        )


def _warn_of_lost_channels(filled: FilledRecording) -> Iterator[str]:
    given, target = filled.request.given, filled.request.target
    lost = np.flatnonzero(target.any(axis=0) & ~given.visible.any(axis=0))
    train = filled.request.train
    if not len(lost) or not train:
        return
    names = join_names([given.channels[channel] for channel in lost], _NAMED)
    caution = (
        f"Of {names}, nothing is visible in the file: no held-out gap tells how well "
        "models fill that."
    )
    if filled.choice and len(train) > 1 and "best-of" not in filled.used:
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


def _warn_of_jumps(filled: FilledRecording) -> Iterator[str]:
    recording = filled.recording
    jumps = find_jumps(recording, filled.request.target)
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
