"""The results bundle: everything that a report is made of, and nothing of how it came about.

The harness fills a `Bundle`; this package turns it into tables, figures and a page. What a
table looks like (its rows, its columns, the names that the paper uses) is data too: a
`TaskLayout` for each task.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import pandas as pd

from mocapbench.metrics.base import Direction
from mocapbench.reports.bundle.pictures import Picture
from mocapbench.reports.bundle.regression_check import RegressionCheck

__all__ = ["Bundle", "CaseLayout", "MetricInfo", "Setting", "TaskLayout"]

Setting = str | int | float

SCORE_COLUMNS = (
    *("task", "case", "fold", "label", "model", "metric", "value", "sample_two_sd", "left_out"),
)
RECORD_COLUMNS = (
    *("task", "case", "fold", "label", "model", "parameters", "status", "message", "traceback"),
    *("fit_seconds", "predict_seconds", "peak_memory_mb", "iterations", "converged", "engine"),
)
STATUSES = ("ok", "failed", "timeout", "out-of-memory", "data-missing")


@dataclass(frozen=True)
class CaseLayout:
    """One row of a task's tables.

    Parameters
    ----------
    name : str
        Unique within the task.
    settings : mapping of str to str, int or float
        What the row varies; each key becomes a column.
    published : str or None
        The row's name in the published values, None where the paper has no such row.
    synthetic : bool
        Whether the row stands on generated rather than recorded motion.
    remark : str
        Shown in the row.
    not_comparable : mapping of str to str
        By label, why the row's published values cannot be set beside ours.
    pooled : bool
        Whether the row is a mean of other rows, which count in its stead over cases.
    """

    name: str
    settings: Mapping[str, Setting]
    published: str | None = None
    synthetic: bool = False
    remark: str = ""
    not_comparable: Mapping[str, str] = field(default_factory=dict)
    pooled: bool = False


@dataclass(frozen=True)
class TaskLayout:
    """What the tables of one task look like.

    Parameters
    ----------
    name, title, reference : str
        Identity, heading, and place in the paper (``"thesis §5.1.1, Tables 1–3"``).
    kind : str
        ``"impute"``, ``"synthesise"``, ``"cluster"`` or ``"recover"``.
    description : str
        One or two sentences for readers.
    cases : tuple of CaseLayout
        Rows, in table order. Rows without any record are not shown.
    labels : tuple of str
        Entrants, in table order.
    metrics : tuple of str
        The tables to show, in order; headlines speak of the first.
    published_models, published_metrics : mapping of str to str
        From our labels and metrics to the paper's names.
    not_comparable : mapping of (label, metric) to str
        Why a published value cannot be set beside ours; metric ``"*"`` stands for all.
    not_controlled : mapping of str to str
        Labels whose samples need not surpass the control's, and why.
    remarks : tuple of str
        Errata and cautions, shown with the tables.
    oracle : str
        The label that is told the generating process: a limit, never ranked.
    control : str
        The label whose samples owe nothing to the data: never ranked either.
    replay : str
        The label whose samples are the training recordings themselves: nor is it.
    independent_folds : bool
        Whether folds are independent draws of the protocol. Overlapping windows of one recording
        are not: their spread is shown, but says nothing of how uncertain the mean is.
    crossed : tuple of two str, or None
        Settings along the rows and the columns of the tables, where one entrant takes part and
        the cases are pairs.
    budget : str
        What the run cut short (``"max_iter=200"``), empty where it spent what the task asks for.
    """

    name: str
    title: str
    reference: str
    kind: str
    description: str
    cases: tuple[CaseLayout, ...]
    labels: tuple[str, ...]
    metrics: tuple[str, ...]
    published_models: Mapping[str, str] = field(default_factory=dict)
    published_metrics: Mapping[str, str] = field(default_factory=dict)
    not_comparable: Mapping[tuple[str, str], str] = field(default_factory=dict)
    not_controlled: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    oracle: str = "oracle"
    control: str = "control"
    replay: str = "replay"
    independent_folds: bool = True
    crossed: tuple[str, str] | None = None
    budget: str = ""

    @property
    def ranked(self) -> tuple[str, ...]:
        """The labels that compete: all but the oracle, the control and the replay."""
        apart = {self.oracle, self.control, self.replay}
        return tuple(label for label in self.labels if label not in apart)


@dataclass(frozen=True)
class MetricInfo:
    """How a metric is called and which way it improves.

    Parameters
    ----------
    name, title : str
        Name in tables and records; heading for people.
    direction : Direction
        Or its value: ``"lower"``, ``"higher"``, ``"target"``.
    target : float or None
        The ideal value where the direction is ``TARGET``.

    Raises
    ------
    ValueError
        If the direction is none of the three, or is ``TARGET`` and the target is missing.
    """

    name: str
    title: str
    direction: Direction
    target: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", Direction(self.direction))
        if self.direction is Direction.TARGET and self.target is None:
            raise ValueError(f"metric {self.name!r}: expected a target, got None")

    def loss(self, value: float) -> float:
        """Return how bad ``value`` is: lower is better whatever the direction."""
        return self.direction.loss(value, self.target)


@dataclass(frozen=True, eq=False)
class Bundle:
    """The results of a run.

    Parameters
    ----------
    scores : DataFrame
        One row per (task, case, fold, label, metric): columns ``task``, ``case``, ``fold``,
        ``label``, ``model``, ``metric``, ``value``, ``sample_two_sd`` (two standard deviations
        over the samples that the value is a mean of, NaN where it is no such mean),
        ``left_out``.
    records : DataFrame
        One row per job: columns ``task``, ``case``, ``fold``, ``label``, ``model``,
        ``parameters``, ``status`` (``ok``, ``failed``, ``timeout``, ``out-of-memory``,
        ``data-missing``), ``message``, ``traceback``, ``fit_seconds``, ``predict_seconds``,
        ``peak_memory_mb``, ``iterations``, ``converged``, ``engine`` (a name, a colon and the
        reason for it, or nothing). The message of a ``data-missing``
        job says how to get the data.
    layouts : tuple of TaskLayout
        The tasks, in page order.
    metrics : mapping of str to MetricInfo
        Every metric in ``scores`` and in the layouts.
    provenance : mapping of str to str
        Shown in order. The summary quotes ``"profile"``, ``"CPU"``, ``"threads"``, ``"started"``,
        ``"wall time"`` and ``"command line"``, and the foot of the page ``"acknowledgement"``,
        where they are there.
    illustrations : tuple of Illustration or HeatMaps
        Figures of the tasks, in page order.
    check : RegressionCheck or None
        What a check against a baseline found, if there was one.

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
    check: RegressionCheck | None = None

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
        shown = {metric for layout in self.layouts for metric in layout.metrics}
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
