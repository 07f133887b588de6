"""Files of recordings that were filled in memory."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.in_memory.recording_inputs import FileRecording
from mocapbench.datasets import Mask, Recording
from mocapbench.reports import csv_text

__all__ = ["save_like"]


def save_like(given: Recording, filled: Recording, mask: Mask, path: Path) -> Path:
    """Write a filled recording, and return its path.

    Parameters
    ----------
    given : Recording
        What was filled; if it is of a file, a copy of this is written.
    filled : Recording
    mask : ndarray of bool of shape (N, D)
        What was filled.
    path : Path
        A new file.

    Raises
    ------
    ValueError
        If there is such a file, or the format cannot be written.
    """
    if path.exists():
        raise ValueError(f"expected a new file, got {path}, which exists; choose another name")
    if isinstance(given, FileRecording):
        given.format.write(path, filled, like=given.path, replaced=mask)
        return path
    if path.suffix.lower() != ".csv":
        raise ValueError(
            f"expected a file called *.csv for a recording that is not of a file, got {path.name}; "
            "name it so, or write to_dataframe()"
        )
    write_text(path, csv_text(_tabulate(filled)))
    return path


def _tabulate(recording: Recording) -> pd.DataFrame:
    """Return a table that is read as the recording: times, and channels with their units."""
    labels = zip(recording.channels, recording.units, strict=True)
    names = [f"{channel} [{unit}]" if unit else channel for channel, unit in labels]
    table = pd.DataFrame(recording.values, columns=names)
    table.insert(0, "time", recording.times)
    return table
