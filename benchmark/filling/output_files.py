"""What is written for a filled file: its copy, tables of filled entries and gaps, and a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Index
from mocapbench.basics.scratch import scratch_folder, sweep_scratch
from mocapbench.basics.temporaries import sweep
from mocapbench.basics.whole_files import write_text, write_together
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import ENTRIES, GAPS, require_short_names, require_writable_folder
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gaps import Gap, mask_gaps
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.datasets import FrameByChannel, Mask
from mocapbench.reports import csv_text

__all__ = [
    "OutputPaths",
    "name_output_files",
    "require_writable",
    "reserve_outputs",
    "tabulate_entries",
    "write",
]

OutputPaths = tuple[Path, Path, Path, Path]
"""The files that are written for one file: its copy, the tables of entries and gaps, and the page.

All are new: neither a file that was read nor an earlier output is overwritten.
"""


def name_output_files(files: Sequence[Path], folder: Path) -> list[OutputPaths]:
    """Return what is to be written for each file.

    Raises
    ------
    UsageError
        If the folder is a file or cannot be written to, or two files would have one name.
    """
    if folder.exists() and not folder.is_dir():
        raise UsageError(f"--out: expected a folder, got the file {folder}; name another")
    require_writable_folder("--out", folder)
    sweep(folder)  # which finishes what a killed process began
    sweep_scratch()  # here, since what that process finished is not filled again
    outputs = [_name_outputs_of(file, folder) for file in files]
    paths = [path for of_one_file in outputs for path in of_one_file]
    if len(set(paths)) < len(paths):
        raise UsageError(
            "expected files of different names, since all are written to one folder; "
            "fill them one by one, each with its own --out"
        )
    return outputs


def _name_outputs_of(file: Path, folder: Path) -> OutputPaths:
    tables = folder / f"{file.name}{ENTRIES}", folder / f"{file.name}{GAPS}"
    return folder / file.name, *tables, folder / f"{file.name}.html"


def require_writable(source: InputFile, outputs: OutputPaths) -> None:
    """Refuse a file whose outputs could not be written, before anything is computed.

    A copy is written elsewhere, in which the first entry to fill of each channel has the nearest
    visible value.

    Raises
    ------
    UsageError
        If an output exists or has too long a name.
    FormatError
        If the format cannot write the copy.
    """
    require_short_names("--out", outputs)
    _require_new(outputs)
    request = source.request
    first = np.zeros_like(request.target)
    channels = np.flatnonzero(request.target.any(axis=0))
    first[request.target[:, channels].argmax(axis=0), channels] = True
    whole = request.given.with_values(_hold_nearest(request.given.values, first))
    with scratch_folder() as folder:
        copy = folder / outputs[0].name
        source.format.write(copy, whole, source.path, first, source.stated)


def _require_new(outputs: OutputPaths) -> None:
    existing = [path for path in outputs if path.exists()]
    if existing:
        raise UsageError(
            f"--out: expected no file called {existing[0]}, which would be overwritten; "
            "name another folder, or delete it"
        )


@contextmanager
def reserve_outputs(outputs: OutputPaths) -> Iterator[OutputPaths]:
    """Keep other processes from writing files, and yield where to write them until they are whole.

    At the end of the context all take their places, or none if anything went wrong.

    Raises
    ------
    UsageError
        If one is there already.
    OSError
        If another process is writing them, or the folder cannot be written to.
    """
    folder, name = outputs[0].parent, outputs[0].name
    folder.mkdir(parents=True, exist_ok=True)
    try:
        with write_together(folder, name) as drafts:
            _require_new(outputs)
            copy, entries, gaps, page = (drafts / path.name for path in outputs)
            yield copy, entries, gaps, page
    except BaseException:
        with suppress(OSError):  # it holds other files
            folder.rmdir()
        raise


def _hold_nearest(values: FrameByChannel, hidden: Mask) -> FrameByChannel:
    """Return values (N, D) with the nearest visible one where hidden, or else 0."""
    result = values.copy()
    for frame, channel in np.argwhere(hidden).tolist():
        seen = np.flatnonzero(~np.isnan(values[:, channel]))
        nearest = seen[np.abs(seen - frame).argmin()] if len(seen) else None
        result[frame, channel] = 0.0 if nearest is None else values[nearest, channel]
    return result


def write(
    input_file: InputFile,
    filled: FilledRecording,
    gaps_table: pd.DataFrame,
    outputs: OutputPaths,
    page: str,
) -> None:
    """Write all files of one filled file.

    Parameters
    ----------
    input_file : InputFile
    filled : FilledRecording
    gaps_table : DataFrame
    outputs : OutputPaths
        What `reserve_outputs` yielded.
    page : str

    Raises
    ------
    FormatError
        If the file's format cannot hold a value.
    OSError
        If a file cannot be written.
    """
    copy_path, entries_path, gaps_path, page_path = outputs
    input_file.format.write(
        copy_path, filled.recording, input_file.path, filled.request.target, input_file.stated
    )
    write_text(entries_path, csv_text(tabulate_entries(filled, input_file.spikes)))
    write_text(gaps_path, csv_text(gaps_table))
    write_text(page_path, page)


def tabulate_entries(filled: FilledRecording, spikes: Sequence[Gap]) -> pd.DataFrame:
    """Return a row per filled entry, by frame.

    Columns ``frame`` (0-based), ``time`` in seconds, ``channel``, ``unit``, ``mean``, ``sd``,
    which is empty where the model has no predictive distribution, ``model``, and ``spike``: 1 where
    the file has a value that was hidden as one, else 0. Angles are unwrapped: they go on from those
    beside the gap, where the file may have them 360° away.
    """
    given = filled.request.given
    frames, channels = np.nonzero(filled.request.target)
    return pd.DataFrame(
        {
            "frame": frames,
            "time": given.times[frames],
            "channel": _repeat_texts(given.channels, channels),
            "unit": _repeat_texts(given.units, channels),
            "mean": filled.prediction.mean,
            "sd": filled.std,
            "model": pd.Categorical(filled.models),
            "spike": mask_gaps(spikes, given.values.shape)[frames, channels].astype(int),
        }
    )


def _repeat_texts(texts: Sequence[str], numbers: Index) -> pd.Categorical:
    """Return the texts of some numbers, each of which takes memory once."""
    distinct, places = np.unique(texts, return_inverse=True)
    return pd.Categorical.from_codes(places[numbers], distinct.tolist())
