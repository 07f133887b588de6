"""The paper's table of one metric: a row per case, a column per entrant, mean ± 2 sd."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from mocapbench.reports.analysis.results import DATA_MISSING, Estimate, TaskResults, Trouble
from mocapbench.reports.bundle.bundle import CaseLayout, TaskLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import footnotes, marks
from mocapbench.reports.tables.base import (
    ABSENT,
    Cell,
    Table,
    counted,
    decimals,
    headings,
    number,
    slug,
)
from mocapbench.reports.tables.rank_notes import rank_notes

__all__ = ["case_name", "score_table", "settings_of"]

MISSING_ID = "missing-data"
FOLDS = "2 sd over folds"
WINDOWS = "spread over overlapping windows (2 sd)"
SAMPLES = "2 sd over the samples of a fold, averaged over folds"


def case_name(case: CaseLayout) -> str:
    """Return the case's name, marked where it stands on generated motion."""
    return f"{case.name} (synthetic)" if case.synthetic else case.name


def settings_of(cases: Sequence[CaseLayout]) -> list[str]:
    """Return the names of the settings of all cases, in order of first appearance."""
    return list(dict.fromkeys(key for case in cases for key in case.settings))


def score_table(results: TaskResults, metric: str) -> Table:
    """Return the table of ``metric``; columns that only the paper has come last."""
    info, cases, labels = results.metrics[metric], results.cases, results.layout.labels
    settings, foreign = settings_of(cases), _published_only(results, metric)
    printed = {
        (c.name, model): _foreign(results, c, metric, model) for c in cases for model in foreign
    }
    lettered = marks(value.erratum for value in printed.values() if value is not None)
    places = decimals(e.mean for (_, _, name), e in results.estimates.items() if name == metric)
    rows = tuple(
        (
            Cell(case.name, note=_case_note(case)),
            *(Cell(str(case.settings.get(key, ""))) for key in settings),
            _folds(results, case.name, metric),
            *_scores(results, case.name, metric, places),
            *(_foreign_cell(printed[case.name, model], places, lettered) for model in foreign),
        )
        for case in cases
    )
    columns = (
        *headings(["case", *settings, "folds", *labels]),
        *headings([f"{model} (published)" for model in foreign], "published"),
    )
    return Table(
        id=slug(results.layout.name, metric),
        caption=f"{info.title}: {_meaning(results, metric)}",
        columns=columns,
        rows=rows,
        data=_tidy(results, metric),
        notes=(*_notes(results, metric), *footnotes(lettered)),
    )


def _meaning(results: TaskResults, metric: str) -> str:
    info = results.metrics[metric]
    goal = info.direction.value if info.target is None else f"closest to {info.target:g}"
    return f"mean ± {_spread_meaning(results, metric)}, {goal} is better, first rank in bold"


def _spread_meaning(results: TaskResults, metric: str) -> str:
    estimates = (e for (_, _, name), e in results.estimates.items() if name == metric)
    if any(estimate.sample_two_sd is not None for estimate in estimates):
        return SAMPLES
    return FOLDS if results.layout.independent_folds else WINDOWS


def _case_note(case: CaseLayout) -> str:
    return " · ".join(filter(None, ["synthetic" if case.synthetic else "", case.remark]))


def _folds(results: TaskResults, case: str, metric: str) -> Cell:
    rank = results.first_rank(case, metric)
    untested = rank is not None and not rank.tested
    return Cell(f"n={_n_folds(results, case, metric)}", note="no test" if untested else "")


def _n_folds(results: TaskResults, case: str, metric: str) -> int:
    found = (results.estimate(case, label, metric) for label in results.layout.labels)
    return max((estimate.n for estimate in found if estimate), default=0)


def _scores(results: TaskResults, case: str, metric: str, places: int) -> list[Cell]:
    labels = results.layout.labels
    records = results.records[results.records["case"] == case]
    if (records["status"] == DATA_MISSING).all():
        return [Cell("data missing", kind="trouble", link=MISSING_ID, span=len(labels))]
    best, expected = results.best(case, metric), _n_folds(results, case, metric)
    return [
        _score(
            results.estimate(case, label, metric),
            results.troubles.get((case, label), ()),
            "best" if label in best else "",
            expected,
            places,
        )
        for label in labels
    ]


def _score(
    estimate: Estimate | None, troubles: Sequence[Trouble], kind: str, expected: int, places: int
) -> Cell:
    counts = Counter(trouble.status.replace("-", " ") for trouble in troubles)
    link = _explanation(troubles[0]) if troubles else ""
    if estimate is None:
        return Cell(", ".join(counts), kind="trouble", link=link) if troubles else ABSENT
    remaining = "" if expected == estimate.n else f"n={estimate.n}"
    lost = [f"{count} {status}" for status, count in counts.items()]
    return Cell(
        text=number(estimate.mean, places),
        spread="" if estimate.spread is None else number(estimate.spread, places),
        note=", ".join(filter(None, [remaining, *lost])),
        kind=kind,
        link=link,
    )


def _explanation(trouble: Trouble) -> str:
    return MISSING_ID if trouble.status == DATA_MISSING else trouble.id


def _published_only(results: TaskResults, metric: str) -> list[str]:
    """Return the paper's models of this metric that none of our labels stands for."""
    name = results.layout.published_metrics.get(metric)
    models = dict.fromkeys(
        value.model
        for value in results.published.values()
        if value.metric == name and not value.not_comparable
    )
    return [model for model in models if model not in results.layout.published_models.values()]


def _foreign(
    results: TaskResults, case: CaseLayout, metric: str, model: str
) -> PublishedValue | None:
    if case.synthetic or case.published is None:
        return None
    return results.published.get((case.published, results.layout.published_metrics[metric], model))


def _foreign_cell(value: PublishedValue | None, places: int, lettered: Mapping[str, str]) -> Cell:
    if value is None:
        return ABSENT
    spread = "" if value.two_sd is None else number(value.two_sd, places)
    mark = lettered[value.erratum]
    return Cell(number(value.value, places), spread=spread, mark=mark, kind="published")


def _notes(results: TaskResults, metric: str) -> tuple[str, ...]:
    left_out = int(
        max(results.scores.loc[results.scores["metric"] == metric, "left_out"], default=0)
    )
    degenerate = (
        f"Left out as degenerate: up to {counted(left_out, 'output')} a fold." if left_out else ""
    )
    apart, tests = _unranked(results.layout), rank_notes(results, metric)
    return tuple(filter(None, [*results.layout.remarks, degenerate, *apart, *tests]))


def _unranked(layout: TaskLayout) -> list[str]:
    """Return why labels that do not compete are shown beside those that do."""
    what = {
        layout.oracle: "knows the generating process: a limit",
        layout.control: "draws from an unrelated process: what no resemblance scores",
        layout.replay: "repeats its training recordings: what they score, with nothing made new",
    }
    beside = layout.labels if layout.ranked else ()
    return [f"{label} {text}, not ranked." for label, text in what.items() if label in beside]


def _tidy(results: TaskResults, metric: str) -> pd.DataFrame:
    """Return one row per (case, label), with n = 0 where there is no score."""
    best = {case.name: results.best(case.name, metric) for case in results.cases}
    return pd.DataFrame(
        [
            {
                "task": results.layout.name,
                "case": case.name,
                **case.settings,
                "synthetic": case.synthetic,
                "label": label,
                "metric": metric,
                **vars(results.estimate(case.name, label, metric) or Estimate(np.nan, None, 0)),
                "first_rank": label in best[case.name],
            }
            for case in results.cases
            for label in results.layout.labels
        ]
    )
