"""What is written for a filled file: its copy, a table of the filled entries, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import ENTRIES, require_short_names, require_writable_folder
from mocapbench.benchmark.filling.filler import Filled
from mocapbench.reports import csv_text

__all__ = ["Outputs", "entry_table", "outputs_of", "write"]


class Outputs(NamedTuple):
    """The files that are written for one file.

    All are new: neither a file that was read nor an earlier output is overwritten.
    """

    filled: Path
    entries: Path
    page: Path


def outputs_of(files: Sequence[Path], folder: Path) -> list[Outputs]:
    """Return what is to be written for each file.

    Raises
    ------
    UsageError
        If the folder is a file or cannot be written to, a file to write exists, has too long a
        name, or two have one name.
    """
    if folder.exists() and not folder.is_dir():
        raise UsageError(f"--out: expected a folder, got the file {folder}; name another")
    require_writable_folder("--out", folder)
    outputs = [
        Outputs(folder / file.name, *(folder / f"{file.name}{end}" for end in (ENTRIES, ".html")))
        for file in files
    ]
    paths = [path for written in outputs for path in written]
    require_short_names("--out", paths)
    existing = [path for path in paths if path.exists()]
    if existing:
        raise UsageError(
            f"--out: expected no file called {existing[0]}, which would be overwritten; "
            "name another folder, or delete it"
        )
    if len(set(paths)) < len(paths):
        raise UsageError(
            "expected files of different names, since all are written to one folder; "
            "fill them one by one, each with its own --out"
        )
    return outputs


def write(filled: Filled, outputs: Outputs, page: str) -> None:
    """Write all files of one filled file, or none.

    Raises
    ------
    FormatError
        If the file's format cannot hold a value.
    OSError
        If a file cannot be written.
    """
    source = filled.source
    outputs.filled.parent.mkdir(parents=True, exist_ok=True)
    try:
        source.format.write(
            outputs.filled, filled.recording, like=source.path, replaced=source.request.target
        )
        write_text(outputs.entries, csv_text(entry_table(filled)))
        write_text(outputs.page, page)
    except BaseException:
        for path in outputs:
            path.unlink(missing_ok=True)
        raise


def entry_table(filled: Filled) -> pd.DataFrame:
    """Return a row per filled entry, by frame.

    Columns ``frame`` (0-based), ``time`` in seconds, ``channel``, ``unit``, ``mean`` and ``sd``,
    which is empty where the model has no predictive distribution. Angles are unwrapped: they go on
    from those beside the gap, where the file may have them a whole turn away.
    """
    given = filled.source.request.given
    frames, channels = np.nonzero(filled.source.request.target)
    return pd.DataFrame(
        {
            "frame": frames,
            "time": given.times[frames],
            "channel": np.array(given.channels)[channels],
            "unit": np.array(given.units)[channels],
            "mean": filled.answer.mean,
            "sd": filled.deviations,
        }
    )
