"""The origins of the cells of a report: what computes each alone, its seed, keys and recordings."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from functools import cache
from glob import escape

from mocapbench.benchmark.runs.record import Record
from mocapbench.reports import Origin

__all__ = ["DIGEST_OF", "FLAGS", "LEFT_OUT", "cell_command", "origins", "recordings"]

DIGEST_OF = "digest of "
"""Begins the names under which provenance has the digests of recordings."""
FOLDER = "mocapbench-cell"
"""Another folder than that of the run, where the cell would be skipped."""

FLAGS = {"--offline", "--dry-run", "--explain", "--no-report"}
LEFT_OUT = {
    *FLAGS,
    *("--profile", "--seed", "--tasks", "--cases", "--models", "--folds", "--out"),
    *("--jobs", "--scheduler", "--cluster", "--threads", "--log-json"),
}
"""Options that the command of a cell states itself, or that do not affect results."""


def origins(records: Sequence[Record]) -> dict[tuple[str, str, str], Origin]:
    """Return the origin of each cell, by task, case and label."""
    cells: dict[tuple[str, str, str], list[Record]] = {}
    for record in records:
        address = record.address
        cells.setdefault((address.task, address.case, address.label), []).append(record)
    return {cell: _origin(of_cell) for cell, of_cell in cells.items()}


def _origin(of_cell: Sequence[Record]) -> Origin:
    return Origin(
        command=cell_command(of_cell),
        seed=of_cell[0].seed,
        keys={record.address.fold or 0: record.key for record in of_cell},
        recordings=recordings(of_cell[0]),
    )


def recordings(record: Record) -> dict[str, str]:
    """Return the digest of each recording that a record stands on, by address."""
    return {
        name.removeprefix(DIGEST_OF): digest
        for name, digest in record.provenance.items()
        if name.startswith(DIGEST_OF)
    }


def cell_command(of_cell: Sequence[Record]) -> tuple[str, ...]:
    """Return the pieces of a POSIX shell command, to be joined by blanks.

    Parameters
    ----------
    of_cell : sequence of Record
        One for each fold of an entrant on a case, one or more. Plugins, metrics, folders and task
        files are taken from the command line in their provenance.

    Returns
    -------
    tuple of str
        What cells of a run, a case, an entrant and a number of folds have in common, so that
        many commands can share their pieces.
    """
    record = of_cell[0]
    address, provenance = record.address, record.provenance
    profile, line = provenance.get("profile", "quick"), provenance.get("command line", "")
    folds = 1 + max(each.address.fold or 0 for each in of_cell)
    return (
        shlex.join(["mocapbench", "run", "--profile", profile, "--seed", str(record.seed)]),
        *_keep_options(line),
        shlex.join(["--tasks", address.task]),
        shlex.join(["--cases", _exactly(address.case)]),
        shlex.join(["--models", address.label]),
        shlex.join(["--folds", str(folds), "--out", FOLDER]),
    )


@cache
def _keep_options(line: str) -> tuple[str, ...]:
    """Return the options of a run that its cells depend on, as one piece, or none."""
    try:
        program, words = shlex.split(line)[:2], iter(shlex.split(line)[2:])
    except ValueError:  # a quotation without an end, which no shell would have run
        return ()
    kept: list[str] = []
    for word in words if program == ["mocapbench", "run"] else ():
        name, bound, _ = word.partition("=")
        option = [word] if bound or name in FLAGS else [word, next(words, "")]
        kept += [] if name in LEFT_OUT else option
    return (shlex.join(kept),) if kept else ()


def _exactly(case: str) -> str:
    """Return what ``--cases`` takes for this case alone: a comma in it would separate two."""
    return escape(case).replace(",", "?") if "," in case else case
