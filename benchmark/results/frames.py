"""Records as tables: what `export` writes and what the report reads."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence

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
    rows = [row for record in records for row in _score_rows(record)]
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
        (
            *_address(record),
            _parameters(record),
            record.status.value,
            record.message,
            record.traceback,
            *(getattr(record, name) for name in _COSTS),
            shlex.join(record.missing),
            record.fetch,
        )
        for record in records
    ]
    columns = [*_ADDRESS, "parameters", "status", "message", "traceback", *_COSTS]
    columns += ["missing", "fetch"]
    return pd.DataFrame(rows, columns=columns)


def _score_rows(record: Record) -> Iterator[tuple[object, ...]]:
    """Yield a row for each score of a record; tuples, since a table of many rows is made of them.

    What tells two rows of one address apart is one object in all of them.
    """
    apart = (
        _parameters(record),
        record.address.version,
        record.seed,
        record.provenance.get("commit", ""),
        record.key,
    )
    for metric, value in record.scores.items():
        of_metric = (metric, value, _sample_two_sd(record, metric), record.left_out.get(metric, 0))
        yield *_address(record), *of_metric, *apart


def _address(record: Record) -> tuple[object, ...]:
    """Return the values of the columns `_ADDRESS`."""
    address = record.address
    return address.task, address.case, address.fold, address.label, record.model


def _sample_two_sd(record: Record, metric: str) -> float:
    samples = np.array(record.parts.get(metric, {}).get("sample", []), dtype=float)
    return 2.0 * float(samples.std(ddof=1)) if len(samples) > 1 else np.nan


def _parameters(record: Record) -> str:
    return ", ".join(f"{name}={value}" for name, value in record.parameters.items())
