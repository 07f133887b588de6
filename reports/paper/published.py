"""The papers' numbers, as the papers print them.

``published.csv`` holds one row per (source, case, metric, model), where ``source`` is the paper's
table, ``case`` its row and ``two_sd`` the ± that it prints, empty where it prints none. Errata and
reasons against a comparison are kept apart from it (`mocapbench.reports.paper.remarks`).
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from io import StringIO

import pandas as pd

from mocapbench.reports.paper.remarks import PublishedAddress, parse_remarks, remark_on

__all__ = [
    "PublishedTask",
    "PublishedValue",
    "every_value",
    "parse_published",
    "published_values",
]

KEY = ["source", "case", "metric", "model"]
COLUMNS = ["source", "task", "case", "settings", "metric", "model", "value", "two_sd"]

PublishedTask = dict[tuple[str, str, str], "PublishedValue"]
"""The values of one task by (case, metric, model), all in the paper's names."""


@dataclass(frozen=True)
class PublishedValue:
    """A number in a paper's table, with the remarks on it.

    Parameters
    ----------
    source : str
        The paper and its table, such as ``"thesis-table-01"``.
    task : str
        Our task.
    case, metric, model : str
        Row, metric and model, in the paper's names.
    value : float
    two_sd : float or None
        The ± that the paper prints.
    erratum : str
        A footnote on an error of the paper, empty where there is none.
    not_comparable : str
        Why no number of ours can be compared with it, empty where one can.
    """

    source: str
    task: str
    case: str
    metric: str
    model: str
    value: float
    two_sd: float | None
    erratum: str = ""
    not_comparable: str = ""

    @property
    def address(self) -> PublishedAddress:
        """Source, case, metric and model."""
        return self.source, self.case, self.metric, self.model


def parse_published(text: str) -> tuple[PublishedValue, ...]:
    """Return the rows of a CSV table of published values.

    Raises
    ------
    ValueError
        If the header is another, a value is not a number, or a (source, case, metric, model)
        occurs twice.
    """
    frame = pd.read_csv(StringIO(text), dtype=str, keep_default_na=False)
    if list(frame) != COLUMNS:
        raise ValueError(f"published values: expected the columns {COLUMNS}, got {list(frame)}")
    twice = frame[frame.duplicated(KEY)]
    if len(twice):
        raise ValueError(f"published values: {KEY} occurs twice: {list(twice.iloc[0][KEY])}")
    return tuple(_value(line, row) for line, row in enumerate(frame.to_dict("records"), start=2))


def _value(line: int, row: Mapping[Hashable, str]) -> PublishedValue:
    names = {field: row[field] for field in ("source", "task", "case", "metric", "model")}
    try:
        two_sd = float(row["two_sd"]) if row["two_sd"] else None
        return PublishedValue(**names, value=float(row["value"]), two_sd=two_sd)
    except ValueError as error:
        raise ValueError(
            f"published values, line {line}: expected numbers for value and two_sd, "
            f"got {row['value']!r} and {row['two_sd']!r}"
        ) from error


@cache
def every_value() -> tuple[PublishedValue, ...]:
    """Return every published number of the package, with the remarks on it."""
    errata, reasons = (
        parse_remarks(_read_text(f"{name}.csv")) for name in ("errata", "not_comparable")
    )
    return tuple(
        replace(
            value,
            erratum=remark_on(value.address, errata),
            not_comparable=remark_on(value.address, reasons),
        )
        for value in parse_published(_read_text("published.csv"))
    )


def _read_text(name: str) -> str:
    return (files(__package__) / name).read_text(encoding="utf-8")


def published_values(task: str) -> PublishedTask:
    """Return the published values of ``task`` by (case, metric, model); empty if there are none."""
    return {
        (value.case, value.metric, value.model): value
        for value in every_value()
        if value.task == task
    }
