"""The command that computes one cell of a run alone, with the same keys."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from functools import cache
from glob import escape

from mocapbench.benchmark.runs.record import Record

__all__ = ["FLAGS", "LEFT_OUT", "cell_command"]

FOLDER = "mocapbench-cell"
"""Another folder than that of the run, where the cell would be skipped."""

FLAGS = {"--offline", "--dry-run", "--explain", "--no-report"}
LEFT_OUT = {
    *FLAGS,
    *("--profile", "--seed", "--tasks", "--cases", "--models", "--folds", "--out"),
    *("--jobs", "--scheduler", "--cluster", "--threads", "--log-json"),
}
"""Options that the command of a cell states itself, or that do not affect results."""


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
    program, words = shlex.split(line)[:2], iter(shlex.split(line)[2:])
    kept: list[str] = []
    for word in words if program == ["mocapbench", "run"] else ():
        name, bound, _ = word.partition("=")
        option = [word] if bound or name in FLAGS else [word, next(words, "")]
        kept += [] if name in LEFT_OUT else option
    return (shlex.join(kept),) if kept else ()


def _exactly(case: str) -> str:
    """Return what ``--cases`` takes for this case alone: a comma in it would separate two."""
    return escape(case).replace(",", "?") if "," in case else case
