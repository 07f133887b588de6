"""From the scores that `mocapbench.evaluate` returns to a bundle, as figures take it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.results.error_parts import along_gap
from mocapbench.reports import Bundle, CaseLayout, ErrorParts, TaskLayout, TaskPage

__all__ = ["UNITS", "bundle_frames", "bundle_scores", "require_columns"]

UNITS: Mapping[str, tuple[str, ...]] = {
    "gap": ("recording", "position"),
    "recording": ("recording",),
}
"""By what counts as one, the columns that tell it apart."""
_TASK = "scores"
_SHOWN = ("mse", "smse", "msll")
"""The metrics that figures show unless another is named, where there are any of them."""
_PROBLEM = ["recording", "position", "gap"]


def bundle_scores(scores: pd.DataFrame, by: str = "gap", column: str = "") -> Bundle:
    """Return scores as a bundle of one task, in which each gap is a fold.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns, perhaps with columns of yours; seconds that models took
        in ``fit_seconds``.
    by : str, default="gap"
        What counts as one: ``"gap"``, where gaps that share frames are one, or ``"recording"``.
    column : str, optional
        Each of its values is a case; by default there is one case.

    Raises
    ------
    ValueError
        If a column is lacking, or there is no score.
    """
    require_columns(scores, [*_PROBLEM, "model", "metric", "value", *filter(None, [column])])
    if by not in UNITS:
        raise ValueError(f"expected by= as one of {', '.join(UNITS)}, got {by!r}")
    if not np.isfinite(scores["value"].to_numpy(float)).any():
        raise ValueError("expected scores, got none that is a number")
    rows = _address_rows(scores, column)
    layout = _lay_out(rows, by, column)
    metrics = {name: metric_info(name) for name in dict.fromkeys(rows["metric"])}
    return Bundle(rows, _tabulate_jobs(rows), (layout,), metrics, {})


def bundle_frames(errors: pd.DataFrame) -> Bundle:
    """Return errors by frame as a bundle, with the mean of each gap and its errors along it.

    Parameters
    ----------
    errors : DataFrame
        What `mocapbench.evaluate_frames` returns.

    Raises
    ------
    ValueError
        If a column is lacking, or there is no error.
    """
    require_columns(errors, [*_PROBLEM, "model", "metric", "time", "value"])
    of_gap = [*_PROBLEM, "model", "metric"]
    bundle = bundle_scores(errors.groupby(of_gap, sort=False)["value"].mean().reset_index())
    courses: dict[tuple[str, str, str], list[NDArray[np.float32]]] = defaultdict(list)
    for name, own in errors.groupby(of_gap, sort=False):
        seen = own.sort_values("time")["value"].to_numpy(float)
        # Frames beside the gap, which tell where it begins and ends.
        courses[_TASK, "", str(name[3])].extend(along_gap(np.pad(seen, 1, constant_values=np.nan)))
    along = {cell: np.stack(found) for cell, found in courses.items() if found}
    parts = ErrorParts({_TASK: str(errors["metric"].iloc[0])}, along)
    return replace(bundle, parts=parts)


def require_columns(scores: pd.DataFrame, names: Sequence[str]) -> None:
    """Refuse a table that lacks columns.

    Raises
    ------
    ValueError
        If it does.
    """
    given: object = scores
    if not isinstance(given, pd.DataFrame):
        raise ValueError(f"expected the table that evaluate returns, got {type(given).__name__}")
    lacking = [name for name in names if name not in scores]
    if lacking:
        raise ValueError(f"expected the columns of evaluate, got none called {', '.join(lacking)}")
    if "value" in names and not pd.api.types.is_numeric_dtype(scores["value"]):
        raise ValueError(
            "expected numbers in the column value, got others; take scores as they are"
        )


def _address_rows(scores: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return the rows with the columns of a bundle: a case, and a fold for each of its gaps."""
    case = scores[column].astype(str) if column else ""
    rows = scores.assign(task=_TASK, case=case, label=scores["model"].astype(str))
    repeated = rows.duplicated(["case", *_PROBLEM, "label", "metric"])
    if repeated.any():
        first = rows[["case", *_PROBLEM, "label", "metric"]][repeated].iloc[0].tolist()
        raise ValueError(
            f"expected one score of each, as `evaluate` returns, got several of {first}"
        )
    gaps = rows.drop_duplicates(["case", *_PROBLEM]).assign(
        fold=lambda own: own.groupby("case", sort=False).cumcount()
    )
    numbered = rows.merge(gaps[["case", *_PROBLEM, "fold"]], on=["case", *_PROBLEM])
    return numbered.assign(model=numbered["label"], sample_two_sd=np.nan, left_out=0)


def _lay_out(rows: pd.DataFrame, by: str, column: str) -> TaskLayout:
    gaps = rows.drop_duplicates(["case", "fold"])
    units = gaps[[*UNITS[by]]].astype(str).agg(" ".join, axis=1)
    cases = tuple(
        CaseLayout(
            str(name),
            {column: own[column].iloc[0]} if column else {},
            subjects=tuple(units[own.index]),
        )
        for name, own in gaps.groupby("case", sort=False)
    )
    known = tuple(dict.fromkeys(rows["metric"]))
    page = TaskPage(
        title="Filled gaps",
        reference="",
        description="",
        metrics=tuple(name for name in _SHOWN if name in known) or known,
        along=(column,) if column else (),
    )
    return TaskLayout(_TASK, page, cases, tuple(dict.fromkeys(rows["label"])))


def _tabulate_jobs(rows: pd.DataFrame) -> pd.DataFrame:
    """Return a row for each model and gap; what is not known is NaN."""
    jobs = rows.drop_duplicates(["case", "fold", "label"]).assign(
        status="ok", parameters="", message="", traceback="", engine=""
    )
    known = jobs.get("fit_seconds", np.nan)
    unknown = dict.fromkeys(("peak_memory_mb", "iterations", "converged"), np.nan)
    return jobs.assign(fit_seconds=known, predict_seconds=0.0, **unknown)
