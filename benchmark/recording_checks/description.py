"""What is said of the check of a file in the terminal: the gravest findings first, in few lines."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

from mocapbench.basics.words import format_count, join_names

__all__ = [
    "TITLES",
    "describe_check",
    "describe_frames",
    "describe_size",
    "describe_together",
    "group_findings",
]

_NAMED = 4
"""Names in a sentence at most."""
_GROUPS, _FIRST = 5, 3
"""Markers of a kind of finding, and findings of each, that are listed at most; JSON has all."""
TITLES = {
    "empty": "frames without any marker",
    "never": "never seen",
    "swap": "two markers trade places",
    "jump": "jumps without return",
    "spike": "spikes",
    "segment": "another distance than usual",
    "rows": "missing rows",
    "zeros": "exactly 0, 0, 0",
    "held": "exactly where the frame before has it",
    "number": "a number in place of missing values",
    "gap": "gaps",
    "before": "not seen before the first time",
    "after": "not seen after the last time",
}
"""Kinds of findings, the gravest first."""
_BETWEEN = {"jump", "rows"}
"""Kinds of what is between two frames."""
Finding = dict[str, Any]


def describe_check(check: dict[str, Any]) -> Iterator[str]:
    """Yield the lines that say what `check_file` returned."""
    yield _describe_file(check)
    for key, words in (("unlabelled", "unlabelled"), ("results", "results of a model")):
        if names := check[key]:
            yield f"  {words}, not checked ({len(names)}): {join_names(names, _NAMED)}"
    if not check["markers"]:
        yield "  no markers, so neither swaps nor segments are sought"
    yield from (f"  {text}" for text in check["remarks"])
    for kind, title in TITLES.items():
        rows = [row for row in check["findings"] if row["kind"] == kind]
        yield from _describe_kind(title, rows) if rows else ()
    if not check["findings"]:
        yield "  nothing was found"


def _describe_file(check: dict[str, Any]) -> str:
    rate = "one frame only" if check["rate"] is None else f"{check['rate']:.6g} frames per second"
    counts = {"marker": len(check["markers"]), "other channel": len(check["others"])}
    units = ", ".join(filter(None, check["units"])) or "no unit"
    told = [format_count(count, noun) for noun, count in counts.items() if count]
    return (
        f"{check['file']}: {format_count(check['frames'], 'frame')}, {rate}, "
        f"{check['seconds']:.3f} s; {' and '.join(told) or 'nothing to check'} ({units})"
    )


def _describe_kind(title: str, rows: Sequence[Finding]) -> Iterator[str]:
    """Yield a line on findings of one kind and one on each marker, the gravest first."""
    groups = group_findings(rows)
    yield f"  {title}: {len(rows)}"
    for group in groups[:_GROUPS]:
        yield f"    {describe_together(group)}"
    if len(groups) > _GROUPS:
        rest = sum(map(len, groups[_GROUPS:]))
        yield f"    and {rest} more of {len(groups) - _GROUPS} others; --json lists all"


def group_findings(rows: Sequence[Finding]) -> list[list[Finding]]:
    """Return findings of one kind by their markers, the gravest first."""
    groups: dict[tuple[str, ...], list[Finding]] = defaultdict(list)
    for row in sorted(rows, key=_measure_gravity, reverse=True):
        groups[tuple(row["markers"])].append(row)
    return [*groups.values()]


def _measure_gravity(row: Finding) -> tuple[float, int]:
    """Return how grave a finding is: by its size, if it has one, or else by its frames."""
    return row["size"] or 0.0, row["stop"] - row["start"]


def describe_together(rows: Sequence[Finding]) -> str:
    """Return a line on findings of one kind in the same markers, of which it names a few."""
    markers = " and ".join(rows[0]["markers"])
    told = [
        ", ".join(filter(None, [describe_frames(row), describe_size(row)])) for row in rows[:_FIRST]
    ]
    n_frames = sum(row["stop"] - row["start"] for row in rows)
    in_all = f", {n_frames} frames" if rows[0]["size"] is None else ""
    many = f"{len(rows)} times{in_all}: " if len(rows) > 1 else ""
    more = f"; and {len(rows) - _FIRST} more" if len(rows) > _FIRST else ""
    return f"{markers}{': ' * bool(markers)}{many}{'; '.join(told)}{more}"


def describe_frames(row: Finding) -> str:
    """Return the frames of a finding, with their number and the time of the first."""
    first, last = row["start"], row["stop"] - 1
    time = f"{row['time']:.2f} s"
    if row["kind"] in _BETWEEN:
        return f"between frames {first} and {last} ({time})"
    if first == last:
        return f"frame {first} ({time})"
    return f"frames {first} to {last} ({last - first + 1}, from {time})"


def describe_size(row: Finding) -> str:
    """Return how large a finding is; nothing of one without a size."""
    if row["size"] is None:
        return ""
    if row["kind"] == "rows":
        return f"{row['size']:.0f}"
    return f"{row['size']:.3g} {row['unit']}".rstrip()
