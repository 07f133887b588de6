"""Which runs may become the reference."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.reference import Reference
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record

__all__ = ["require_updatable"]


def require_updatable(
    reference: Path, run: Reference, records: Sequence[Record], n_planned: int, allow_failures: bool
) -> None:
    """Refuse to write a run's values as the reference if some are lacking, or to a wrong place.

    Parameters
    ----------
    reference : Path
        Where they would be written.
    run : Reference
        The values of the run.
    records : sequence of Record
        Its whole records.
    n_planned : int
        How many there should be.
    allow_failures : bool
        Whether jobs may have failed.

    Raises
    ------
    UsageError
        If the run cannot become the reference.
    """
    _require_place(reference)
    _require_whole(records, n_planned)
    if not allow_failures:
        _require_success(records)
    if not run.values:
        raise UsageError("--update: the run holds no value; run it first")


def _require_place(reference: Path) -> None:
    if reference.is_dir() and RunDirectory.is_run(reference):
        raise UsageError(f"--update: {reference} is a run directory; name a .csv file or a folder")
    if reference.is_file() and reference.suffix != ".csv":
        raise UsageError(f"--update: expected a .csv file or a folder, got the file {reference}")


def _require_whole(records: Sequence[Record], n_planned: int) -> None:
    n_lacking = n_planned - len(records)
    if n_lacking:
        lacking = format_count(n_lacking, "job of the run has", "jobs of the run have")
        raise UsageError(
            f"--update: {lacking} no whole record, so the reference would be incomplete; resume "
            "it with `mocapbench run`"
        )


def _require_success(records: Sequence[Record]) -> None:
    failed = [record for record in records if record.status.broken]
    if failed:
        raise UsageError(
            f"--update: {format_count(len(failed), 'job')} failed ({failed[0].address.label}: "
            f"{failed[0].message}); mend them, or keep their old values with --allow-failures"
        )
