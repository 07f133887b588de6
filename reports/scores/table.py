"""From the results of a task to its table of scores by one metric: a row a model, a column a case.

Competitors come first, best on top, then references, then models of the paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import DATA_MISSING, TaskResults
from mocapbench.reports.analysis.standings import Place, Standing, standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.scores.strips import draw_strips
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.tables.base import ABSENT, Cell
from mocapbench.reports.text import FEWEST_DECIMALS, cell_anchor, number, slug

__all__ = ["ScoreRow", "behind_cell", "describe_basis", "score_table"]

Head = tuple[str, tuple[str, ...]]
"""The name of a column, with what its case varies, such as ``"noise 0.1"``, and remarks on it."""


@dataclass(frozen=True)
class ScoreRow:
    """The scores of one model.

    Parameters
    ----------
    label : str
    kind : str
        ``"ranked"``, ``"reference"`` (a limit or a control, not ranked) or ``"published"`` (a
        model of a paper that no entrant stands for).
    mean : Cell
        Over the cases that enter means.
    behind : Cell
        By how much the mean is worse than the best, with its interval where there is a test.
    strip : Markup or None
        Its values drawn.
    cells : tuple of Cell
        One for each head.
    family : str
    """

    label: str
    kind: str
    mean: Cell
    behind: Cell
    strip: Markup | None
    cells: tuple[Cell, ...]
    family: str = ""


def score_table(
    results: TaskResults, metric: str, styles: Mapping[str, DrawingStyle]
) -> dict[str, Any]:
    """Return the table of ``metric``, best first, as the page's template reads it.

    Parameters
    ----------
    results : TaskResults
    metric : str
    styles : mapping of str to DrawingStyle
        How each label is drawn.

    Returns
    -------
    dict
        Its ``id`` on the page; the ``metric`` and its ``title``; which values are ``better``; the
        ``basis`` of means and intervals; the head of each column in ``heads``, and ``mean_head``,
        that of the means, which is that of the case where there is but one; the ``rows``, each a
        `ScoreRow`; and the ``axis`` that the drawings of all rows share, None where there is none.
    """
    counting = results.representative_cases(metric)
    others = [case for case in results.cases if case not in counting]
    shown = [*counting, *others] if len(results.cases) > 1 else []
    strips, axis = draw_strips(results, metric, counting, styles)
    whole = f"mean of {format_count(len(counting), 'case')}"
    return {
        "id": slug(results.layout.name, metric),
        "metric": metric,
        "title": results.metrics[metric].title,
        "better": results.metrics[metric].better,
        "basis": describe_basis(results, metric, counting),
        "mean_head": _head(results, results.cases[0]) if len(results.cases) == 1 else (whole, ()),
        "heads": tuple(_head(results, case) for case in shown),
        "rows": (
            *_entrant_rows(results, metric, counting, shown, strips),
            *_published_rows(results, metric, counting, shown),
        ),
        "axis": axis,
    }


def describe_basis(results: TaskResults, metric: str, cases: Sequence[CaseLayout]) -> str:
    """Return how many cases, folds and outputs the means of ``metric`` over ``cases`` rest on."""
    names = {case.name for case in cases}
    rows = results.scores[results.scores["metric"] == metric]
    sizes = {
        estimate.n
        for (case, _, name), estimate in results.estimates.items()
        if name == metric and case in names
    }
    *fewer, most = sorted(sizes) or [0]
    folds = " or ".join([*map(str, fewer), format_count(most, "fold")])
    left_out = int(max(rows["left_out"], default=0))
    lost = f", up to {format_count(left_out, 'output')} left out as degenerate" if left_out else ""
    each = " each" if len(cases) > 1 else ""
    return f"{format_count(len(cases), 'case')}, {folds}{each}{lost}"


def _head(results: TaskResults, case: CaseLayout) -> Head:
    """Return the name of a case with what it varies and the name does not say."""
    facts = [
        f"{name} {value}" for name, value in case.columns.items() if str(value) not in case.name
    ]
    lacking = "recording missing" if case.name in results.without_data else ""
    generated = "generated" if case.synthetic and "synthetic" not in case.name else ""
    return case.name, tuple(filter(None, (*facts, generated, lacking)))


def _entrant_rows(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
    strips: Mapping[str, Markup],
) -> Iterator[ScoreRow]:
    """Yield the rows of labels with a score, or with a job that gave none."""
    layout, places = results.layout, results.decimals.get(metric, FEWEST_DECIMALS)
    ranked = {standing.label: standing for standing in standings(results, metric)}
    others = sorted(set(layout.labels) - set(ranked), key=layout.labels.index)
    others.sort(key=lambda label: label not in layout.ranked)
    columns = [_case_cells(results, metric, case) for case in shown]
    if len(results.cases) == 1:
        means = _case_cells(results, metric, results.cases[0])
    else:
        means = _mean_cells(results, metric, counting, ranked)
    for label in [*ranked, *others]:
        cells = tuple(column[label] for column in columns)
        if any(cell is not ABSENT for cell in (means[label], *cells)):
            yield ScoreRow(
                label,
                "ranked" if label in layout.ranked else "reference",
                means[label],
                behind_cell(ranked.get(label), places),
                strips.get(label),
                cells,
                layout.model(label).family,
            )


def _case_cells(results: TaskResults, metric: str, case: CaseLayout) -> Mapping[str, Cell]:
    """Return the cell of each label in one case, the best one bold."""
    best = results.best_label(case.name, metric)
    return {
        label: _case_cell(results, metric, case.name, label, kind="best" if label == best else "")
        for label in results.layout.labels
    }


def _case_cell(results: TaskResults, metric: str, case: str, label: str, *, kind: str) -> Cell:
    """Return the mean over folds, or why there is none."""
    estimate = results.estimate(case, label, metric)
    failures = results.find_failures(case, label, metric)
    link = cell_anchor(results.layout.name, case, label)
    if estimate is None:  # where the recording is missing, the head says so
        statuses = dict.fromkeys(failure.status for failure in failures)
        reasons = [status.replace("-", " ") for status in statuses if status != DATA_MISSING]
        return Cell(", ".join(reasons), kind="failure", link=link) if reasons else ABSENT
    lost = f"{format_count(len(failures), 'fold')} lost" if failures else ""
    text = number(estimate.mean, results.decimals[metric])
    return Cell(text, value=estimate.mean, kind=kind, note=lost, link=link)


def _mean_cells(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    ranked: Mapping[str, Standing],
) -> Mapping[str, Cell]:
    """Return the mean of each label over the cases that count, the best of all bold."""
    places, cells = results.decimals.get(metric, FEWEST_DECIMALS), {}
    for label in results.layout.labels:
        means, standing = results.case_means(metric, label), ranked.get(label)
        if not means:
            cells[label] = ABSENT
            continue
        mean = float(np.mean(means)) if standing is None else standing.mean
        cells[label] = Cell(
            number(mean, places),
            value=mean,
            kind="best" if standing and standing.standing is Place.BEST else "",
            note="" if len(means) == len(counting) else f"{len(means)} of {len(counting)} cases",
            link=cell_anchor(results.layout.name, "", label),
        )
    return cells


def behind_cell(standing: Standing | None, places: int) -> Cell:
    """Return by how much a mean is worse than the best, with its interval where there is one.

    A difference that may be chance is marked.
    """
    if standing is None or standing.standing is Place.BEST:
        return Cell("")
    if standing.standing is Place.INCOMPLETE:
        return ABSENT
    mark = "≈ " if standing.standing is Place.INSEPARABLE else ""
    low, high = number(standing.low, places), number(standing.high, places)
    return Cell(
        f"{mark}+{number(standing.difference, places)}",
        value=standing.difference,
        kind="tied" if mark else "",
        note="" if math.isnan(standing.low) else f"{low} to {high}",
    )


def _published_rows(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
) -> Iterator[ScoreRow]:
    """Yield a row for each model of the paper that no entrant of the run stands for.

    Its mean is the one that the paper prints of all its cases, where these are those ``counting``,
    or else that of the latter, if all have one.
    """
    places, page = results.decimals.get(metric, FEWEST_DECIMALS), results.layout.page
    rows = {page.published_rows.get(case.name) for case in counting}
    mean_row = page.published_mean if {*page.published_rows.values()} <= rows else ""
    for model, printed in _published_models(results, metric).items():
        find = partial(_printed_value, page.published_rows, printed)
        values = [*map(find, counting)]
        whole = [value for value in values if value is not None]
        mean = float(np.mean(whole)) if whole and len(whole) == len(values) else None
        shown_mean = _published_mean_cell(printed.get(mean_row), mean, places)
        if whole or shown_mean is not ABSENT:
            yield ScoreRow(
                f"{model} (published)",
                "published",
                shown_mean,
                ABSENT,
                None,
                tuple(_published_cell(find(case), places) for case in shown),
            )


def _published_mean_cell(printed: float | None, of_cases: float | None, places: int) -> Cell:
    """Return the printed mean, with that of the printed cases below it where it is another."""
    if printed is None:
        return _published_cell(of_cases, places)
    cell = _published_cell(printed, places)
    if of_cases is None or abs(printed - of_cases) <= 0.5 * 10.0**-places:
        return cell
    return replace(cell, note=f"{number(of_cases, places)} by its cases")


def _published_models(results: TaskResults, metric: str) -> Mapping[str, dict[str, float]]:
    """Return the values of each model by the paper's name of the case."""
    page = results.layout.page
    name, ours = page.published_metrics.get(metric), set(page.published_models.values())
    models: dict[str, dict[str, float]] = {}
    for value in results.published.values():
        if value.metric == name and value.model not in ours and not value.not_comparable:
            models.setdefault(value.model, {})[value.case] = value.value
    return models


def _printed_value(
    rows: Mapping[str, str], printed: Mapping[str, float], case: CaseLayout
) -> float | None:
    return None if case.synthetic else printed.get(rows.get(case.name, ""))


def _published_cell(value: float | None, places: int) -> Cell:
    return ABSENT if value is None else Cell(number(value, places), value=value, kind="published")
