"""Baselines: the per-fold values that a run is held against.

A baseline is text that a review can read: a CSV file with one row per (task, version, case, label,
metric), sorted, and a column per fold, below a head that says what the values were computed with.
It is kept as one file, or as a folder with a file per task; a run directory serves as one too.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.store import Store

__all__ = ["ENVIRONMENT", "Address", "Baseline", "of_records", "read_baseline", "write_baseline"]

FORMAT = "mocapbench baseline"
ENVIRONMENT = (
    *("machine", "libc", "BLAS"),
    *(f"{library} version" for library in ("numpy", "scipy", "scikit-learn")),
)
_REQUEST = ("profile", "seed")
_UNKNOWN = "unknown"
_FOLD = "fold "


class Address(NamedTuple):
    """Whose values they are, of which metric."""

    task: str
    version: int
    case: str
    label: str
    metric: str


@dataclass(frozen=True)
class Baseline:
    """Values by address and fold, and what they were computed with.

    Parameters
    ----------
    values : mapping of Address to mapping of int to float
        Finite values by fold.
    about : mapping of str to str
        Profile, seed, and what decides the last digits; where records differ, all their values.
    """

    values: Mapping[Address, Mapping[int, float]]
    about: Mapping[str, str] = field(default_factory=dict)


def of_records(records: Sequence[Record], plan: Mapping[str, Any]) -> Baseline:
    """Return the finite scores of a run.

    Parameters
    ----------
    records : sequence of Record
    plan : mapping
        What the run was asked to do, as the store keeps it.
    """
    values: dict[Address, dict[int, float]] = {}
    for record in records:
        for metric, value in record.scores.items():
            if math.isfinite(value):
                address = Address(record.task, record.version, record.case, record.label, metric)
                values.setdefault(address, {})[record.fold] = value
    asked = {name: plan["provenance"].get(name, _UNKNOWN) for name in _REQUEST}
    scored = [record.provenance for record in records if record.scores]
    return Baseline(values, {**asked, **_gathered(scored, ENVIRONMENT)})


def _gathered(parts: Sequence[Mapping[str, str]], names: Iterable[str]) -> dict[str, str]:
    """Return what ``parts`` tell, side by side where they differ."""
    told = {name: sorted({part.get(name, _UNKNOWN) for part in parts}) for name in names}
    return {name: " and ".join(values) for name, values in told.items()}


def read_baseline(path: Path) -> Baseline | None:
    """Return the baseline in a file, a folder of files or a run directory; None if none is there.

    Raises
    ------
    UsageError
        If a file is not a baseline, the files of a folder do not belong together, or a record of
        a run directory is damaged.
    """
    if path.is_dir() and Store.is_run(path):
        store = Store.open(path)
        records = store.planned()
        if store.damaged:
            raise UsageError(
                f"--baseline: {path} holds a damaged record ({store.damaged[0]}); run "
                "`mocapbench run` there again, which mends it"
            )
        return of_records(records, store.load_plan())
    files = sorted(path.glob("*.csv")) if path.is_dir() else [path] * path.is_file()
    return _joined(path, [_parse(file) for file in files]) if files else None


def _joined(path: Path, parts: Sequence[Baseline]) -> Baseline:
    about = _gathered([part.about for part in parts], (*_REQUEST, *ENVIRONMENT))
    for name in _REQUEST:
        if len({part.about.get(name) for part in parts}) > 1:
            raise UsageError(
                f"--baseline: expected one {name} in all files of {path}, got {about[name]}; "
                "delete them and write them again with --update"
            )
    return Baseline(_distinct(row for part in parts for row in part.values.items()), about)


def _distinct(
    rows: Iterable[tuple[Address, Mapping[int, float]]],
) -> dict[Address, Mapping[int, float]]:
    """Return ``rows`` by address: which of two rows a merge meant cannot be known."""
    values: dict[Address, Mapping[int, float]] = {}
    for address, folds in rows:
        if address in values:
            raise UsageError(f"--baseline: {', '.join(map(str, address))} has two rows; keep one")
        values[address] = folds
    return values


def _parse(path: Path) -> Baseline:
    try:
        *lines, rest = path.read_text(encoding="utf-8").split("\n")
        head = [line[2:] for line in lines if line.startswith("# ")]
        if head[:1] != [FORMAT]:
            raise ValueError(f"its first line is not '# {FORMAT}'")
        if rest:
            raise ValueError("its last line is cut short")
        values = _distinct(map(_row, csv.DictReader(lines[len(head) :], strict=True)))
        return Baseline(values, dict(line.split(": ", 1) for line in head[1:]))
    except (OSError, ValueError, KeyError, TypeError, csv.Error) as error:
        raise UsageError(
            f"--baseline: {path} is not a baseline ({error}); mend it, or delete it and write one "
            "with --update"
        ) from error


def _row(row: Mapping[Any, Any]) -> tuple[Address, Mapping[int, float]]:
    if None in row or None in row.values():
        raise ValueError(f"expected as many cells in a row as in the head, got {[*row.values()]}")
    address = Address(row["task"], int(row["version"]), row["case"], row["label"], row["metric"])
    values = {
        int(name.removeprefix(_FOLD)): float(text)
        for name, text in row.items()
        if name.startswith(_FOLD) and text
    }
    if not (values and all(map(math.isfinite, values.values()))):
        raise ValueError(f"expected finite values of {address.metric}, got {values}")
    return address, values


def write_baseline(path: Path, baseline: Baseline) -> None:
    """Write ``baseline`` to a ``.csv`` file, or to one per task of a folder; each is whole."""
    if path.suffix == ".csv" and not path.is_dir():
        return _write(path, baseline.values, baseline.about)
    by_task: dict[str, dict[Address, Mapping[int, float]]] = {}
    for address, folds in baseline.values.items():
        by_task.setdefault(address.task, {})[address] = folds
    for task, values in by_task.items():
        _write(path / f"{task}.csv", values, baseline.about)
    for file in path.glob("*.csv"):
        if file.stem not in by_task:
            file.unlink()
    return None


def _write(
    path: Path, values: Mapping[Address, Mapping[int, float]], about: Mapping[str, str]
) -> None:
    folds = range(1 + max(fold for folds in values.values() for fold in folds))
    buffer = io.StringIO()
    buffer.writelines(f"# {line}\n" for line in (FORMAT, *(f"{k}: {v}" for k, v in about.items())))
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow([*Address._fields, *(f"{_FOLD}{fold}" for fold in folds)])
    for address, by_fold in sorted(values.items()):
        writer.writerow([*address, *(by_fold.get(fold) for fold in folds)])
    path.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(path) as file:
        file.write(buffer.getvalue().encode())
