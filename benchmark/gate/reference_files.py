"""Reference values as text that a review can read.

A CSV file has one row per (task, version, case, label, metric), sorted, and a column per fold,
below a head that says what the values were computed with. Names are guarded where a spreadsheet
would take them for formulas, and read back as they were. Reference values are one file, or a
folder with a file per task; a run directory serves as reference too.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from itertools import takewhile
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta

from mocapbench.basics.temporaries import sweep
from mocapbench.basics.whole_files import encode_text, write_together
from mocapbench.basics.words import printable
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import is_file_name
from mocapbench.benchmark.foreign_files import (
    Finite,
    ForeignFileError,
    Index,
    Name,
    decode_rows,
    fit_schema,
    list_schema,
    read_file,
    read_text,
    table_schema,
)
from mocapbench.benchmark.gate.reference import (
    COLUMNS,
    ENVIRONMENT,
    REQUEST,
    Folds,
    Reference,
    Series,
    join_facts,
    of_records,
)
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.tasks.address import Address
from mocapbench.reports.spreadsheet import guard_text, unguard_text

__all__ = ["read_reference", "write_reference"]

FORMAT = "mocapbench baseline"
"""The first line of a file, from the time when reference values were called a baseline."""
_FOLD = "fold "
_Values = Annotated[dict[Index, Finite], Meta(min_length=1)]
"""One or more finite values, by fold."""
_ROW = table_schema(
    {
        **{"task": Name, "version": Index, "case": Name, "label": Name, "metric": Name},
        "folds": _Values,
    }
)


def read_reference(path: Path) -> Reference | None:
    """Return the values in a file, a folder of files or a run directory; None if none is there.

    Raises
    ------
    UsageError
        If a file holds no reference values, the files of a folder do not belong together, or a
        record of a run directory is damaged.
    """
    if path.is_dir() and RunDirectory.is_run(path):
        store = RunDirectory(path)
        records = store.planned()
        if store.damaged:
            raise UsageError(
                f"--reference: {path} holds a damaged record ({store.damaged[0]}); run "
                "`mocapbench run` there again, which mends it"
            )
        return of_records(records, store.load_plan())
    sweep(path if path.is_dir() else path.parent)  # which finishes what a killed update began
    files = sorted(path.glob("*.csv")) if path.is_dir() else [path] * path.is_file()
    return _join_references(path, [_parse(file) for file in files]) if files else None


def _join_references(path: Path, parts: Sequence[Reference]) -> Reference:
    about = join_facts([part.about for part in parts], (*REQUEST, *ENVIRONMENT))
    for name in REQUEST:
        if len({part.about.get(name) for part in parts}) > 1:
            raise UsageError(
                f"--reference: expected one {name} in all files of {path}, got {about[name]}; "
                "delete them and write them again with --update"
            )
    return Reference(_distinct(row for part in parts for row in part.values.items()), about)


def _distinct(rows: Iterable[tuple[Series, Folds]]) -> dict[Series, Folds]:
    """Return the rows by series, each of which must stand once: a merge may leave two."""
    values: dict[Series, Folds] = {}
    for series, folds in rows:
        if series in values:
            raise ForeignFileError(f"{series} has two rows; keep one")
        values[series] = folds
    return values


def _parse(path: Path) -> Reference:
    advice = "mend it, or delete it and write it again with --update"
    return read_file(path, "reference values", advice, _read_values)


def _read_values(path: Path) -> Reference:
    *lines, rest = read_text(path).split("\n")
    head = [line[2:] for line in takewhile(lambda line: line.startswith("# "), lines)]
    if head[:1] != [FORMAT]:
        raise ForeignFileError(f"its first line is not '# {FORMAT}'")
    if rest:
        raise ForeignFileError("its last line is cut short")
    facts = [line.partition(": ") for line in head[1:]]
    if not all(colon for _, colon, _ in facts):
        raise ForeignFileError("expected lines such as '# seed: 0' at its beginning")
    cells = map(_nest_folds, decode_rows(lines[len(head) :]))
    rows: list[dict[str, Any]] = fit_schema([*cells], list_schema(_ROW), strict=False)
    return Reference(_distinct(map(_row, rows)), {name: fact for name, _, fact in facts})


def _nest_folds(row: Mapping[str, str]) -> dict[str, Any]:
    """Return a row with its values in one entry, by fold."""
    folds = {
        name.removeprefix(_FOLD): cell
        for name, cell in row.items()
        if name.startswith(_FOLD) and cell
    }
    return {**{name: unguard_text(row[name]) for name in COLUMNS if name in row}, "folds": folds}


def _row(row: Mapping[str, Any]) -> tuple[Series, Folds]:
    address = Address(row["task"], row["version"], row["case"], label=row["label"])
    return Series(address, row["metric"]), row["folds"]


def write_reference(path: Path, reference: Reference) -> None:
    """Write the values to a ``.csv`` file, or to one per task of a folder, all together.

    Raises
    ------
    UsageError
        If a name does not fit on a line, or a task's name does not serve as that of a file.
    """
    _require_lines(reference.values)
    if path.suffix == ".csv" and not path.is_dir():
        return _write(path.parent, {path.name: reference.values}, reference.about)
    by_task: dict[str, dict[Series, Folds]] = {}
    for series, folds in reference.values.items():
        by_task.setdefault(series.address.task, {})[series] = folds
    _require_file_names(by_task)
    return _write(
        path,
        {f"{task}.csv": values for task, values in by_task.items()},
        reference.about,
        [file.name for file in path.glob("*.csv")],
    )


def _require_lines(values: Iterable[Series]) -> None:
    """Refuse names that would break a row in two."""
    for series in values:
        if {"\r", "\n"} & set(str(series)):
            raise UsageError(f"--update: expected names of one line, got {series}; rename it")


def _require_file_names(tasks: Iterable[str]) -> None:
    """Refuse what is no name of a file on every system, or a name that cannot be shown."""
    for task in tasks:
        if task != printable(task) or not is_file_name(f"{task}.csv"):
            raise UsageError(
                f"--update: expected a task whose name can be that of a file, got {task!r}; "
                "rename it, or name a .csv file for all tasks"
            )


def _write(
    folder: Path,
    files: Mapping[str, Mapping[Series, Folds]],
    about: Mapping[str, str],
    earlier: Iterable[str] = (),
) -> None:
    """Write the values of each file in place of earlier files."""
    folder.mkdir(parents=True, exist_ok=True)
    with write_together(folder, "reference", obsolete={*earlier} - files.keys()) as drafts:
        for name, values in files.items():
            (drafts / name).write_bytes(encode_text(_format(values, about)))


def _format(values: Mapping[Series, Folds], about: Mapping[str, str]) -> str:
    folds = range(1 + max(fold for folds in values.values() for fold in folds))
    buffer = io.StringIO()
    buffer.writelines(f"# {line}\n" for line in (FORMAT, *(f"{k}: {v}" for k, v in about.items())))
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow([*COLUMNS, *(f"{_FOLD}{fold}" for fold in folds)])
    for series, by_fold in sorted(values.items()):
        cells = (guard_text(str(cell)) for cell in series.cells)
        writer.writerow([*cells, *(by_fold.get(fold) for fold in folds)])
    return buffer.getvalue()
