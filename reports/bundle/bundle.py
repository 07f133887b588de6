"""The results bundle: everything that a report is made of.

The harness fills a `Bundle`; this package turns it into tables, figures and a page. The layout of
each task's tables (rows, columns, the names that the paper uses) is data too: a `TaskLayout`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import pandas as pd

from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.origin import Origin
from mocapbench.reports.bundle.pictures import Picture

__all__ = ["STATUSES", "Bundle"]

SCORE_COLUMNS = (
    *("task", "case", "fold", "label", "model", "metric", "value", "sample_two_sd", "left_out"),
)
RECORD_COLUMNS = (
    *("task", "case", "fold", "label", "model", "parameters", "status", "message", "traceback"),
    *("fit_seconds", "predict_seconds", "peak_memory_mb", "iterations", "converged", "engine"),
)
STATUSES = ("ok", "failed", "timeout", "out-of-memory", "data-missing")


@dataclass(frozen=True, eq=False)
class Bundle:
    """The results of a run.

    Parameters
    ----------
    scores : DataFrame
        One row per (task, case, fold, label, metric): columns ``task``, ``case``, ``fold``,
        ``label``, ``model``, ``metric``, ``value``, ``sample_two_sd`` (two standard deviations
        over samples where the value is a mean over samples, NaN elsewhere), ``left_out`` (the
        number of degenerate outputs that the value leaves out).
    records : DataFrame
        One row per job: columns ``task``, ``case``, ``fold``, ``label``, ``model``,
        ``parameters``, ``status`` (``ok``, ``failed``, ``timeout``, ``out-of-memory``,
        ``data-missing``), ``message``, ``traceback``, ``fit_seconds``, ``predict_seconds``,
        ``peak_memory_mb``, ``iterations``, ``converged``, ``engine`` (a name, a colon and the
        reason for it, or nothing). The message of a ``data-missing`` job says how to get the
        data. Columns ``missing`` and ``fetch`` may have the names of its recordings, as a shell
        takes them, and the command that gets them, up to their names.
    layouts : tuple of TaskLayout
        The tasks, in page order.
    metrics : mapping of str to MetricInfo
        Every metric in ``scores`` and in the layouts.
    provenance : mapping of str to str
        Shown in order. The summary quotes ``"profile"``, ``"CPU"``, ``"threads"``, ``"started"``,
        ``"wall time"`` and ``"command line"``, and the foot of the page ``"acknowledgement"``,
        where the mapping has them.
    illustrations : tuple of Illustration, HeatMaps, Space or Motions
        Figures of the tasks, in page order.
    check : mapping or None
        The result of the last check against reference values, if there was one: where these come
        from, ``reference``; counts and environment in a line, ``summary``; whether the run
        ``passed``; and ``findings``, a mapping for each (task, case, label, metric) with these
        names, ``verdict``, ``fails``, ``reason``, and where values were paired ``n``,
        ``reference``, ``run``, ``change``, ``worst`` and ``allowance``.
    origins : mapping of (task, case, label) to Origin
        Where the scores of each cell come from, as far as it is known.
    parts : ErrorParts
        Errors along gaps and by joint.

    Raises
    ------
    ValueError
        If a column is missing, or a table names a task, case, label, metric or status that the
        layouts and metrics do not know.
    """

    scores: pd.DataFrame
    records: pd.DataFrame
    layouts: tuple[TaskLayout, ...]
    metrics: Mapping[str, MetricInfo]
    provenance: Mapping[str, str]
    illustrations: tuple[Picture, ...] = ()
    check: Mapping[str, Any] | None = None
    origins: Mapping[tuple[str, str, str], Origin] = field(default_factory=dict)
    parts: ErrorParts = field(default_factory=ErrorParts)

    def __post_init__(self) -> None:
        _require_columns("scores", self.scores, SCORE_COLUMNS)
        _require_columns("records", self.records, RECORD_COLUMNS)
        addresses = {
            (layout.name, case.name, label)
            for layout in self.layouts
            for case in layout.cases
            for label in layout.labels
        }
        for frame in (self.scores, self.records):
            used = frame[["task", "case", "label"]].drop_duplicates()
            _require_known(
                "(task, case, label)", used.itertuples(index=False, name=None), addresses
            )
        shown = {metric for layout in self.layouts for metric in layout.page.metrics}
        _require_known("metrics", {*shown, *self.scores["metric"]}, self.metrics)
        _require_known("statuses", set(self.records["status"]), STATUSES)
        illustrated = {illustration.task for illustration in self.illustrations}
        _require_known("tasks", illustrated, {layout.name for layout in self.layouts})


def _require_columns(name: str, frame: pd.DataFrame, columns: Iterable[str]) -> None:
    missing = [column for column in columns if column not in frame]
    if missing:
        raise ValueError(f"{name}: expected columns {list(columns)}, {missing} are missing")


def _require_known(what: str, used: Iterable[object], known: Iterable[object]) -> None:
    unknown = sorted(map(repr, set(used) - set(known)))
    if unknown:
        raise ValueError(
            f"expected {what} of the layouts and metrics of the bundle, got {', '.join(unknown)}"
        )
