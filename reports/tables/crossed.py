"""The table of a task whose cases are pairs, such as every recording with every other."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.tables.letters import letters
from mocapbench.reports.text import cell_anchor, number, slug

__all__ = ["cross_table"]

Lettered = dict[str, str]


def cross_table(results: TaskResults, metric: str, crossed: tuple[str, str]) -> Table:
    """Return the table of ``metric`` with one column of the cases along rows, one along columns.

    Parameters
    ----------
    results : TaskResults
        Of one entrant.
    metric : str
    crossed : tuple of two str
        The columns of the cases (`CaseLayout.columns`) along rows and along columns.

    Returns
    -------
    Table
        The published value is shown below ours.
    """
    along_rows, along_columns = crossed
    pairs = {
        (str(case.columns[along_rows]), str(case.columns[along_columns])): case
        for case in results.cases
    }
    rows, columns = (list(dict.fromkeys(names)) for names in zip(*pairs, strict=True))
    lettered = letters(results)
    return Table(
        id=slug(results.layout.name, metric),
        caption=f"{results.metrics[metric].title} of each {along_rows} with each {along_columns}, "
        "and the published value below it",
        columns=headings([along_rows, *columns]),
        rows=tuple(
            (Cell(row), *(_cell(results, pairs.get((row, at)), metric, lettered) for at in columns))
            for row in rows
        ),
    )


def _cell(results: TaskResults, case: CaseLayout | None, metric: str, lettered: Lettered) -> Cell:
    if case is None:
        return ABSENT
    (label,) = results.layout.labels
    estimate = results.estimate(case.name, label, metric)
    if estimate is None:
        return Cell("missing", kind="failure")
    places = results.decimals[metric]
    note = _note(results.published_value(case, label, metric), places, lettered)
    link = cell_anchor(results.layout.name, case.name, label)
    return Cell(number(estimate.mean, places), note=note, link=link)


def _note(published: PublishedValue | None, places: int, lettered: Lettered) -> str:
    if published is None:
        return ""
    letter = lettered[published.erratum]
    return number(published.value, places) + (f" ({letter})" if letter else "")
