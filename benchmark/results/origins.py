"""The origins of the cells of a report, from the records of a run."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.benchmark.results.cell_commands import cell_command
from mocapbench.benchmark.runs.record import Record
from mocapbench.reports import Origin

__all__ = ["DIGEST_OF", "origins", "recordings"]

DIGEST_OF = "digest of "
"""Begins the names under which provenance has the digests of recordings."""


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
