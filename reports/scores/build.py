"""From the results of a task to its table of scores by one metric."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.styles import Style
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.scores.behind import behind_cell, mean_cell
from mocapbench.reports.scores.cells import cell_address, published_cell, score_cell
from mocapbench.reports.scores.drawing import Drawing
from mocapbench.reports.scores.table import NO_SCORE, CaseHead, ScoreCell, ScoreRow, ScoreTable
from mocapbench.reports.text import counted, decimals, number, slug

__all__ = ["metric_places", "score_table"]


def metric_places(results: TaskResults, metric: str) -> int:
    """Return how many decimals the means of ``metric`` are shown with."""
    return decimals(e.mean for (_, _, name), e in results.estimates.items() if name == metric)


def score_table(results: TaskResults, metric: str, styles: Mapping[str, Style]) -> ScoreTable:
    """Return the table of ``metric``: competitors best first, then references and papers' models.

    The mean is over the representative cases, each of which weighs the same.

    Parameters
    ----------
    results : TaskResults
    metric : str
    styles : mapping of str to Style
        How each label is drawn.
    """
    counting = results.representative_cases(metric)
    shown = [] if len(results.cases) == 1 else _in_order(results, counting)
    places = metric_places(results, metric)
    info = results.metrics[metric]
    drawing = Drawing.of(results, metric, counting, styles)
    return ScoreTable(
        id=slug(results.layout.name, metric),
        metric=metric,
        title=info.title,
        better=info.better,
        basis=_basis(results, metric, counting),
        mean_head=CaseHead(f"mean of {counted(len(counting), 'case')}") if shown else _only(results),
        heads=tuple(map(_head, shown)),
        rows=tuple(_rows(results, metric, counting, shown, places, drawing)),
        axis=drawing.axis,
    )


def _in_order(results: TaskResults, counting: Sequence[CaseLayout]) -> list[CaseLayout]:
    """Return the cases that count, then the others."""
    return [*counting, *(case for case in results.cases if case not in counting)]


def _only(results: TaskResults) -> CaseHead:
    return _head(results.cases[0]) if results.cases else CaseHead("mean")


def _head(case: CaseLayout) -> CaseHead:
    facts = [f"{name} {value}" for name, value in case.columns.items() if str(value) != case.name]
    told = [*facts, *filter(None, ["generated" if case.synthetic else case.remark])]
    return CaseHead(case.name, tuple(told))


def _basis(results: TaskResults, metric: str, counting: Sequence[CaseLayout]) -> str:
    folds = {
        estimate.n
        for (case, _, name), estimate in results.estimates.items()
        if name == metric and case in {each.name for each in counting}
    }
    *fewer, most = sorted(folds) or [0]
    counts = " or ".join([*map(str, fewer), counted(most, "fold")])
    left_out = results.scores.loc[results.scores["metric"] == metric, "left_out"]
    degenerate = int(left_out.max()) if len(left_out) else 0
    lost = f", up to {counted(degenerate, 'output')} left out as degenerate" if degenerate else ""
    return f"{counted(len(counting), 'case')}, {counts}{lost}"


def _rows(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
    places: int,
    drawing: Drawing,
) -> Iterator[ScoreRow]:
    ranked = {standing.label: standing for standing in standings(results, metric)}
    competing = set(results.layout.ranked)
    others = [label for label in results.layout.labels if label not in ranked]
    for label in [*ranked, *sorted(others, key=lambda name: name not in competing)]:
        standing = ranked.get(label)
        cells = tuple(score_cell(results, case, label, metric, places) for case in shown)
        if standing is None and not any(cell is not NO_SCORE for cell in cells) and shown:
            continue
        yield ScoreRow(
            label,
            "ranked" if label in competing else "reference",
            _mean(results, metric, label, counting, places, standing),
            behind_cell(standing, places),
            drawing.strip(label),
            cells,
            results.layout.model(label).family,
        )
    yield from _published(results, metric, counting, shown, places)


def _mean(
    results: TaskResults,
    metric: str,
    label: str,
    counting: Sequence[CaseLayout],
    places: int,
    standing: Standing | None,
) -> ScoreCell:
    """Return the mean over the cases that count; with one case it leads to what is behind it."""
    if len(results.cases) == 1:
        return score_cell(results, results.cases[0], label, metric, places)
    found = [results.estimate(case.name, label, metric) for case in counting]
    means = [estimate.mean for estimate in found if estimate is not None]
    link = cell_address(results.layout.name, "", label)
    return mean_cell(means, len(counting), standing, places, link)


def _published(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
    places: int,
) -> Iterator[ScoreRow]:
    """Return a row for each of the paper's models that none of our labels stands for."""
    page = results.layout.page
    name = page.published_metrics.get(metric)
    rows: dict[str, dict[str, PublishedValue]] = {}
    for value in results.published.values():
        if value.metric == name and not value.not_comparable:
            rows.setdefault(value.model, {})[value.case] = value
    for model, by_row in rows.items():
        values = [_printed(case, by_row) for case in counting]
        if model in page.published_models.values() or not any(values):
            continue
        printed = [value.value for value in values if value is not None]
        whole = len(printed) == len(values)
        mean = float(np.mean(printed))
        yield ScoreRow(
            f"{model} (published)",
            "published",
            ScoreCell(number(mean, places), mean, "published") if whole else NO_SCORE,
            NO_SCORE,
            None,
            tuple(published_cell(_printed(case, by_row), places) for case in shown),
        )


def _printed(case: CaseLayout, by_row: dict[str, PublishedValue]) -> PublishedValue | None:
    return None if case.synthetic else by_row.get(case.notes.published or "")
