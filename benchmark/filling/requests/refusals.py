"""What is said where a request cannot be met."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from operator import itemgetter

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gaps import Gap, count_entries, find_gaps
from mocapbench.benchmark.filling.requests.names import (
    match_pattern,
    name_hidden_markers,
    name_markers,
    name_owners,
)
from mocapbench.benchmark.missing_values import undecided_values
from mocapbench.datasets import Mask, Recording

__all__ = [
    "NothingToFillError",
    "explain_all_left",
    "explain_no_channel",
    "explain_no_gap",
    "explain_no_named_gap",
    "explain_nothing_known",
    "explain_only_ends",
]

_NAMED = 3
_MOST_KNOWN = 12
_PATTERNS = "In a pattern, * stands for any characters and ? for any one, such as a comma"


class NothingToFillError(UsageError):
    """A recording that needs no filling; others may need it."""


def explain_no_channel(channels: Sequence[str], pattern: str) -> str:
    """Return that a pattern matches no channel, and names that are near to it."""
    near = _find_near(channels, pattern)
    known = join_names([*dict.fromkeys(name_owners(channels))], _MOST_KNOWN)
    advice = f"did you mean {' or '.join(near)}?" if near else f"there are {known}."
    return f"expected the name of a marker, joint or channel, got {pattern!r}: {advice} {_PATTERNS}"


def explain_no_named_gap(channels: Sequence[str], target: Mask, pattern: str, text: str) -> str:
    """Return that a rule names nothing that is to be filled, with markers near and their gaps."""
    owners = name_owners(channels)
    matched = {owners[k] for k in np.flatnonzero(match_pattern(channels, pattern))}
    near = matched or {*_find_near(channels, pattern)}
    advice = f": did you mean {' or '.join(sorted(near))}?" if near - matched else "."
    gaps = [
        (owner not in near, f"{owner}:{gap.start}-{gap.stop - 1}")
        for gap in find_gaps(target)
        for owner in dict.fromkeys(owners[channel] for channel in gap.channels)
    ]
    nearest = [gap for _, gap in sorted(gaps, key=itemgetter(0))]
    return (
        f"expected a gap to fill, got {text!r}, which names none{advice} "
        f"Gaps to fill are {join_names(nearest, _MOST_KNOWN)}. {_PATTERNS}"
    )


def explain_all_left(recording: Recording) -> str:
    """Return that the user leaves all gaps open."""
    return f"{recording.name}: expected a gap to fill, got all left open by --leave or --only"


def _find_near(channels: Sequence[str], pattern: str) -> list[str]:
    """Return markers and joints, or else channels, near to a pattern in spelling."""
    owners = dict.fromkeys(name_owners(channels))
    near = difflib.get_close_matches(pattern, owners, n=_NAMED)
    return near or difflib.get_close_matches(pattern, channels, n=_NAMED)


def explain_no_gap(
    recording: Recording,
    patterns: Sequence[str],
    unlabelled: Sequence[str],
    outputs: Sequence[str],
) -> str:
    """Return that nothing is hidden in the channels of patterns, or in those of markers."""
    if (unlabelled or outputs) and not patterns:
        strays, results = (len(name_markers(names)) for names in (unlabelled, outputs))
        counts = [
            format_count(strays, "unlabelled marker") if strays else "",
            format_count(results, "result of a model", "results of a model") if results else "",
        ]
        names = name_markers((*unlabelled, *outputs))
        return (
            f"{recording.name}: expected a gap in a labelled marker, got hidden entries of "
            f"{' and '.join(filter(None, counts))} only ({join_names(names, _NAMED)}); "
            "--channels '*' fills all channels"
        )
    which = f"entries of {', '.join(patterns)}" if patterns else "entries"
    hints = (
        f"{recording.name}: expected a gap, got all {which} visible; name what to fill with "
        "--frames, such as 120:180",
        undecided_values(recording),
    )
    return ". ".join(filter(None, hints)).rstrip(".")


def explain_nothing_known(recording: Recording, unknown: Sequence[str]) -> str:
    """Return that of no channel to fill anything is visible."""
    return (
        f"{recording.name}: expected a visible entry of a channel to fill, got none of "
        f"{join_names(name_markers(unknown), _NAMED)}; name files that have these with --train"
    )


def explain_only_ends(
    recording: Recording, open_ends: Sequence[Gap], blank_ends: Sequence[Gap]
) -> str:
    """Return that nothing is hidden but before or after what is visible."""
    expected = f"{recording.name}: expected a gap between visible entries, got none"
    if not open_ends:
        frames = format_count(sum(map(len, blank_ends)), "frame")
        return (
            f"{expected}, but {frames} at the beginning or the end in which nothing is visible; "
            "name what to fill with --frames, such as 120:180"
        )
    entries = format_count(count_entries(open_ends), "hidden entry", "hidden entries")
    names = join_names(name_hidden_markers(recording.channels, open_ends), _NAMED)
    return (
        f"{expected}, but {entries} before the first visible one or after the last ({names}); "
        "--ends fill fills them"
    )
