"""The records of a run directory, one JSON file each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.directory.files_by_key import FilesByKey
from mocapbench.benchmark.runs.record import Record, RecordError

__all__ = ["RECORDS", "RecordFiles"]

RECORDS = "records"


class RecordFiles:
    """The records of a run directory.

    Parameters
    ----------
    run : Path
        The run directory.
    damaged : list of str
        To which a message is added for every file that is truncated or foreign.
    """

    def __init__(self, run: Path, damaged: list[str]) -> None:
        self.files = FilesByKey(run / RECORDS, ".json")
        self._damaged = damaged

    def load(self, key: str) -> Record | None:
        """Return the record called ``key``, or None if it is absent or damaged."""
        path = self.files.find(key)
        if not path.is_file():
            return None
        try:
            record = Record.from_json(path.read_bytes())
            if record.key != key:
                raise RecordError(f"it holds the record {record.key}")
        except (OSError, RecordError) as error:
            self._damaged.append(f"{path}: {error}")
            return None
        return _with_metrics_of_today(record)

    def save(self, record: Record) -> None:
        """Write ``record`` whole or not at all."""
        write_text(self.files.make_room(record.key), record.to_json())


def _with_metrics_of_today(record: Record) -> Record:
    """Return ``record`` with today's names of metrics: earlier versions wrote former ones."""
    return replace(
        record,
        scores=_renamed(record.scores),
        parts=_renamed(record.parts),
        left_out=_renamed(record.left_out),
    )


def _renamed(by_metric: Mapping[str, Any]) -> dict[str, Any]:
    return {METRICS.renamed(name): value for name, value in by_metric.items()}
