"""What the dialog of a cell shows: everything of every cell as one compact JSON document.

A cell is a task, a case and a label. Each stands in its task as a row of values, which
``columns`` names. What many cells have in common, such as parameters, pieces of commands and
digests of recordings, stands once in ``shared`` and is referred to by its place there.
"""

from __future__ import annotations

from base64 import b64encode
from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from functools import partial
from itertools import count
from typing import Any

from jinja2.utils import htmlsafe_json_dumps
from markupsafe import Markup

from mocapbench.reports.analysis.comparisons import Comparison, every_comparison
from mocapbench.reports.analysis.estimates import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.origin import Origin
from mocapbench.reports.resources import dump_json

__all__ = ["COLUMNS", "Origins", "cells_json"]

COLUMNS = (
    *("case", "label", "model", "parameters", "seed", "command", "recordings", "folds", "keys"),
    *("fit_seconds", "predict_seconds", "peak_memory_mb", "failures", "scores"),
)
"""``folds`` to ``peak_memory_mb`` have one value a fold; ``keys`` are their bytes in base 64.
``scores`` has for each metric of the task its values by fold, their mean, half the 95 % interval
of the mean where there are several units, and the published value beside it where there is one."""

Origins = Mapping[tuple[str, str, str], Origin]
"""By task, case and label."""
Jobs = Sequence[tuple[Any, ...]]
"""By fold: the fold, model, parameters, seconds to fit and to predict, megabytes."""
Places = dict[Hashable, int]
"""The place of each value in ``shared``; a new value takes the next one."""

_GOALS = {"lower": "lower is better", "higher": "higher is better"}
_UNKNOWN = Origin((), 0, {}, {})


def cells_json(results: Sequence[TaskResults], origins: Origins) -> Markup:
    """Return the cells of all tasks as JSON that may stand in a script element.

    Parameters
    ----------
    results : sequence of TaskResults
    origins : mapping of (task, case, label) to Origin
        Cells without one have neither keys nor command.
    """
    shared: Places = defaultdict(count().__next__)
    tasks = {
        of_task.layout.name: {
            "title": of_task.layout.page.title,
            "metrics": [_describe(of_task.metrics[name]) for name in of_task.layout.page.metrics],
            "rows": list(_encode_rows(of_task, origins, shared)),
        }
        for of_task in results
    }
    document = {"columns": COLUMNS, "tasks": tasks, "shared": list(shared)}
    return htmlsafe_json_dumps(document, dumps=partial(dump_json, separators=(",", ":")))


def _describe(info: MetricInfo) -> list[str]:
    return [info.name, info.short, _GOALS.get(info.direction.value, f"{info.target} is ideal")]


def _encode_rows(results: TaskResults, origins: Origins, shared: Places) -> Iterator[list[Any]]:
    """Yield the values of each cell, as `COLUMNS` names them."""
    metrics = results.layout.page.metrics
    published = {(p.case.name, p.label, p.metric): p for p in every_comparison(results)}
    for cell, jobs in _collect_jobs(results).items():
        origin = origins.get((results.layout.name, *cell), _UNKNOWN)
        failures = results.failures.get(cell, ())
        scores = [
            (results.estimate(*at), _values_of(results, at, jobs), published.get(at))
            for at in ((*cell, metric) for metric in metrics)
        ]
        yield [
            *_encode_jobs(cell, jobs, origin, shared),
            [[f.fold, shared[f.status], shared[f.message], f.id] for f in failures],
            [_encode_score(*score, shared) for score in scores],
        ]


def _values_of(results: TaskResults, at: tuple[str, str, str], jobs: Jobs) -> list[float | None]:
    """Return the value of each job at a case, a label and a metric."""
    values = results.values_by_fold(*at)
    return [values.get(job[0]) for job in jobs]


def _encode_jobs(cell: tuple[str, str], jobs: Jobs, origin: Origin, shared: Places) -> list[Any]:
    folds, models, parameters, *costs = zip(*jobs, strict=True)
    keys = _join_keys([origin.keys.get(fold, "") for fold in folds])
    return [
        *(shared[text] for text in (*cell, models[0], parameters[0])),
        origin.seed,
        [shared[piece] for piece in origin.command],
        shared[tuple(origin.recordings.items())],
        folds,
        b64encode(keys).decode(),
        *([_round_digits(value, 2) for value in of_folds] for of_folds in costs),
    ]


def _encode_score(
    estimate: FoldMean | None, values: Sequence[Any], pair: Comparison | None, shared: Places
) -> list[Any] | None:
    if estimate is None:
        return None
    mean, half_width = _round_digits(estimate.mean), _round_digits(estimate.half_width)
    published = [_encode_published(pair, shared)] if pair else []
    return [[*map(_round_digits, values)], mean, half_width, *published]


def _encode_published(pair: Comparison, shared: Places) -> list[Any]:
    paper = pair.published
    texts = (paper.source, pair.verdict.value, pair.reason, paper.erratum)
    return [paper.value, paper.two_sd, *(shared[text] for text in texts)]


def _collect_jobs(results: TaskResults) -> dict[tuple[str, str], Jobs]:
    """Return the jobs of each cell by fold, cells in table order."""
    names = ("case", "label", "fold", "model", "parameters")
    costs = ("fit_seconds", "predict_seconds", "peak_memory_mb")
    cells: dict[tuple[str, str], list[tuple[Any, ...]]] = {
        (case.name, label): [] for case in results.cases for label in results.layout.labels
    }
    for case, label, *job in results.records[[*names, *costs]].itertuples(index=False, name=None):
        cells[case, label].append(tuple(job))
    return {cell: sorted(jobs, key=lambda job: job[0]) for cell, jobs in cells.items() if jobs}


def _round_digits(value: float | None, digits: int = 6) -> float | None:
    """Return ``value`` with so many significant digits, None where there is no finite value."""
    if value is None or not abs(value) < float("inf"):
        return None
    rounded = float(f"{value:.{digits}g}")
    return int(rounded) if rounded.is_integer() else rounded  # shorter by ".0"


def _join_keys(keys: Sequence[str]) -> bytes:
    """Return keys of hexadecimal digits as bytes; nothing where one is not a key of a run."""
    try:
        return b"".join(map(bytes.fromhex, keys))
    except ValueError:
        return b""
