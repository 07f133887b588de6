"""The table of all filled gaps: where each is, what filled it, and what makes it doubtful."""

from __future__ import annotations

import shlex
from collections import defaultdict
from collections.abc import Mapping, Sequence
from glob import escape

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Index
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_cautions import GapCautions, Jump
from mocapbench.benchmark.filling.gaps import Gap, count_entries, find_gaps
from mocapbench.benchmark.filling.jumps import measure_edges
from mocapbench.benchmark.filling.requests.names import match_pattern, name_owners
from mocapbench.benchmark.filling.requests.request import FillRequest, measure_gap

__all__ = ["describe_gaps", "describe_options", "sort_by_caution", "tabulate_gaps"]

_COLUMNS = (
    *("marker", "unit", "first", "last", "seconds", "kind", "model"),
    *("error", "low", "high", "jump", "caution", "leave"),
)
_PLAIN = "linear", "makima"
"""Models that fill any gap, of which one is named as another."""
_BETWEEN = "; "
"""What stands between cautions of one gap."""


_Row = tuple[Gap, Kind, str]
"""A gap of one marker or joint, in channels of one unit, its kind, and the model that filled it."""


def tabulate_gaps(filled: FilledRecording) -> pd.DataFrame:
    """Return a row for each marker or joint and unit of each filled gap, by their first frame.

    Every filled entry is in exactly one row: a gap that several models filled has one for each.

    Returns
    -------
    DataFrame
        ``marker`` or joint, or channels where only some of those of its unit were filled;
        ``unit``; ``first`` and ``last`` filled frame (0-based); ``seconds``; ``kind`` of gap;
        ``model``; its ``error``, the mean over held-out gaps of this kind of the root mean squared
        error, and the bounds ``low`` and ``high`` of the 95 % interval (Student's t over
        independent positions), all empty where none was held out, and the bounds also where
        positions are too few; ``jump``, the largest step at an edge relative to the largest between
        visible frames of the channel; ``caution``, what makes it doubtful; and ``leave``, the
        rules of `NamedEntries` that leave it open, with commas between.
    """
    given, rows = filled.request.given, [*_find_rows(filled)]
    edges = measure_edges(filled.recording, filled.request.target)
    numbers = _number_rows(rows, edges, filled)
    largest = edges["relative"].groupby(numbers).max().reindex(range(len(rows)))
    jumps = _group_jumps(edges[edges["jumps"]], numbers)
    cautions = GapCautions(filled)
    table = [
        (
            _name_gap(given.channels, given.units, gap),
            kind.unit,
            gap.start,
            gap.stop - 1,
            measure_gap(given, gap),
            str(kind),
            model,
            *_expect_error(filled.choice, kind, model),
            jump,
            _BETWEEN.join(cautions.list_of(gap, kind, jumps[number])),
            _compose_rules(filled.request, gap),
        )
        for number, ((gap, kind, model), jump) in enumerate(zip(rows, largest, strict=True))
    ]
    return pd.DataFrame(table, columns=_COLUMNS)


def sort_by_caution(table: pd.DataFrame) -> pd.DataFrame:
    """Return a table of gaps, those with most cautions first, and of these the longest."""
    n_cautions = table["caution"].str.count(_BETWEEN) + (table["caution"] != "")
    order = np.lexsort((table["first"], -table["seconds"], -n_cautions))
    return table.iloc[order].reset_index(drop=True)


def describe_gaps(table: pd.DataFrame) -> pd.DataFrame:
    """Return what people read of a table of gaps, as text: a row a gap, in the same order."""
    return pd.DataFrame(
        {
            "gap": table["marker"],
            "frames": [f"{row.first}-{row.last}" for row in table.itertuples()],
            "seconds": table["seconds"].map("{:.3g}".format),
            "filled by": table["model"],
            "expected error": [*map(_describe_error, *(table[name] for name in _OF_ERROR))],
            "jump": table["jump"].map("{:.2g}".format, na_action="ignore").fillna("–"),
            "caution": table["caution"],
            "leave it open by": table["leave"].map(_quote_option),
        }
    )


_OF_ERROR = "error", "low", "high", "unit"


def _describe_error(error: float, low: float, high: float, unit: str) -> str:
    if np.isnan(error):
        return "–"
    bounds = "" if np.isnan(low) else f" ({low:.2g} to {high:.2g})"
    return f"{error:.2g}{bounds} {unit}".rstrip()


def _quote_option(rules: str) -> str:
    return f"--leave {shlex.quote(rules)}"


def describe_options(filled: FilledRecording, table: pd.DataFrame) -> str:
    """Return how the first gap of a table is left open, or filled otherwise."""
    model, rules = table["model"].iloc[0], table["leave"].iloc[0]
    other = next(name for name in _PLAIN if name != model)
    named = ",".join(f"{rule}={other}" for rule in rules.split(","))
    first, *more = {*filled.request.models.tolist()}
    option = f"--model {shlex.quote(f'{named},*={first}')}"
    return (
        f"To leave a gap open, add its option, such as {_quote_option(rules)}. To fill it by "
        f"another model, write {f'{named} first in --model' if more else option}. Other gaps stay "
        "as they are."
    )


def _find_rows(filled: FilledRecording) -> list[_Row]:
    """Return the rows by their first frame, and by the order of channels."""
    owners = name_owners(filled.request.given.channels)
    rows: list[_Row] = []
    for number, model in {*zip(filled.kinds.tolist(), filled.models.tolist(), strict=True)}:
        mask = np.zeros(filled.request.target.shape, dtype=bool)
        mask[filled.request.target] = (filled.kinds == number) & (filled.models == model)
        for gap in find_gaps(mask):
            of_owner: dict[str, list[int]] = defaultdict(list)
            for channel in gap.channels:
                of_owner[owners[channel]].append(channel)
            for channels in of_owner.values():
                alone = Gap(gap.start, gap.stop, tuple(channels))
                rows.append((alone, filled.all_kinds[number], model))
    return sorted(rows, key=lambda row: (row[0].start, row[0].channels))


def _number_rows(rows: Sequence[_Row], edges: pd.DataFrame, filled: FilledRecording) -> Index:
    """Return the number of the row that each edge (K,) is of."""
    numbers = np.full(filled.request.target.shape, -1, dtype=np.int32)
    for number, (gap, _, _) in enumerate(rows):
        numbers[gap.start : gap.stop, list(gap.channels)] = number
    return np.asarray(numbers[edges["frame"], edges["channel"]], dtype=np.intp)


def _group_jumps(jumps: pd.DataFrame, numbers: Index) -> Mapping[int, list[Jump]]:
    """Return the channel and the frame of each jump, by the row that it is of."""
    of_row: dict[int, list[Jump]] = defaultdict(list)
    pairs = zip(jumps["channel"].tolist(), jumps["frame"].tolist(), strict=True)
    for number, pair in zip(numbers[jumps.index].tolist(), pairs, strict=True):
        of_row[number].append(pair)
    return of_row


def _name_gap(channels: Sequence[str], units: Sequence[str], gap: Gap) -> str:
    """Return the marker or joint of a gap, or its channels where others of it have its unit."""
    owners = name_owners(channels)
    owner, unit = owners[gap.channels[0]], units[gap.channels[0]]
    alike = [k for k, one in enumerate(owners) if one == owner and units[k] == unit]
    if alike == [*gap.channels]:
        return owner
    return ", ".join(channels[channel] for channel in gap.channels)


def _expect_error(choice: Choice | None, kind: Kind, model: str) -> tuple[float, float, float]:
    """Return the mean error of a model in held-out gaps of a kind and its bounds, NaN if none."""
    ranking = choice.rankings.get(kind) if choice else None
    if ranking is None or model not in ranking.means:
        return np.nan, np.nan, np.nan
    return ranking.means[model], *ranking.intervals[model]


def _compose_rules(request: FillRequest, gap: Gap) -> str:
    """Return the rules that name a gap: one of its marker if that names nothing else."""
    channels = request.given.channels
    owner = escape(name_owners(channels)[gap.channels[0]])
    same = match_pattern(channels, owner) & request.target[gap.start : gap.stop]
    alone = int(same.sum()) == count_entries([gap])
    names = [owner] if alone else [escape(channels[channel]) for channel in gap.channels]
    # A comma separates rules.
    return ",".join(f"{name.replace(',', '?')}:{gap.start}-{gap.stop - 1}" for name in names)
