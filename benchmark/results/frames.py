"""Records as tables: what `export` writes and what the report reads."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

import numpy as np
import pandas as pd

from mocapbench.benchmark.runs.record import Record

__all__ = ["job_table", "score_table"]

_ADDRESS = ["task", "case", "fold", "label", "model"]
_COSTS = ["fit_seconds", "predict_seconds", "peak_memory_mb", "iterations", "converged", "engine"]


def score_table(records: Sequence[Record]) -> pd.DataFrame:
    """Return one row per (task, case, fold, label, metric).

    Columns: ``task, case, fold, label, model, metric, value, sample_two_sd, left_out``, and what
    tells two rows of one address apart: ``parameters, version, seed, commit, key``. Two standard
    deviations (ddof 1) over samples are NaN where the value is not a mean over two or more.
    """
    rows = [
        {
            **_address(record),
            "metric": metric,
            "value": value,
            "sample_two_sd": _sample_two_sd(record, metric),
            "left_out": record.left_out.get(metric, 0),
            "parameters": _parameters(record),
            "version": record.address.version,
            "seed": record.seed,
            "commit": record.provenance.get("commit", ""),
            "key": record.key,
        }
        for record in records
        for metric, value in record.scores.items()
    ]
    columns = [*_ADDRESS, "metric", "value", "sample_two_sd", "left_out"]
    columns += ["parameters", "version", "seed", "commit", "key"]
    return pd.DataFrame(rows, columns=columns)


def job_table(records: Sequence[Record]) -> pd.DataFrame:
    """Return one row per job, with how it ended and what it cost.

    Columns: ``task, case, fold, label, model, parameters, status, message, traceback``,
    ``fit_seconds, predict_seconds, peak_memory_mb, iterations, converged, engine``, and of a job
    that lacked recordings ``missing``, their names as a shell takes them, and ``fetch``, the
    command that gets them, up to their names.
    """
    rows = [
        {
            **_address(record),
            **{name: getattr(record, name) for name in _COSTS},
            "parameters": _parameters(record),
            "status": record.status.value,
            "message": record.message,
            "traceback": record.traceback,
            "missing": shlex.join(record.missing),
            "fetch": record.fetch,
        }
        for record in records
    ]
    columns = [*_ADDRESS, "parameters", "status", "message", "traceback", *_COSTS]
    columns += ["missing", "fetch"]
    return pd.DataFrame(rows, columns=columns)


def _address(record: Record) -> dict[str, object]:
    return {**record.address._asdict(), "model": record.model}


def _sample_two_sd(record: Record, metric: str) -> float:
    samples = np.array(record.parts.get(metric, {}).get("sample", []), dtype=float)
    return 2.0 * float(samples.std(ddof=1)) if len(samples) > 1 else np.nan


def _parameters(record: Record) -> str:
    return ", ".join(f"{name}={value}" for name, value in record.parameters.items())
