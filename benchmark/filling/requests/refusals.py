"""What is said where a request cannot be met."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UsageError, first_of
from mocapbench.benchmark.filling.gaps import Gap, count_entries
from mocapbench.benchmark.filling.requests.names import name_hidden_markers, name_markers
from mocapbench.benchmark.missing_values import undecided_values
from mocapbench.datasets import Recording

__all__ = [
    "NothingToFillError",
    "explain_no_gap",
    "explain_nothing_known",
    "explain_only_ends",
]

_NAMED = 3


class NothingToFillError(UsageError):
    """A recording that needs no filling; others may need it."""


def explain_no_gap(
    recording: Recording, pattern: str | None, unlabelled: Sequence[str], outputs: Sequence[str]
) -> str:
    """Return that nothing is hidden in the channels of a pattern, or in those of markers."""
    if (unlabelled or outputs) and pattern is None:
        strays, results = (len(name_markers(names)) for names in (unlabelled, outputs))
        counts = [
            format_count(strays, "unlabelled marker") if strays else "",
            format_count(results, "result of a model", "results of a model") if results else "",
        ]
        names = name_markers((*unlabelled, *outputs))
        return (
            f"{recording.name}: expected a gap in a labelled marker, got hidden entries of "
            f"{' and '.join(filter(None, counts))} only ({first_of(names, _NAMED)}); "
            "--channels '.*' fills all channels"
        )
    which = "entries" if pattern is None else f"entries of {pattern!r}"
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
        f"{first_of(name_markers(unknown), _NAMED)}; name files that have these with --train"
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
    names = first_of(name_hidden_markers(recording.channels, open_ends), _NAMED)
    return (
        f"{expected}, but {entries} before the first visible one or after the last ({names}); "
        "--ends fill fills them"
    )
