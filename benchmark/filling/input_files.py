"""The user's input files: those to fill, and those to learn from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mocapbench.benchmark.filling.gap_problem import GapProblem, select_channels
from mocapbench.benchmark.filling.reading import Reading
from mocapbench.benchmark.filling.requests.channels import match_channels
from mocapbench.benchmark.filling.requests.refusals import NothingToFillError
from mocapbench.benchmark.filling.requests.request import FillRequest, NamedEntries, select
from mocapbench.datasets import Format, Recording, check_alike
from mocapbench.datasets.formats.strays import is_unlabelled

__all__ = ["InputFile", "read_input_files"]


@dataclass(frozen=True, eq=False)
class InputFile:
    """A file to fill.

    Parameters
    ----------
    path : Path
    format : Format
        In which it is read and written.
    request : FillRequest
        What of it is to be filled.
    train : tuple of Recording
        Other files that models learn from, with the channels of the file, in its order; unlabelled
        markers and results of a model that they lack are hidden throughout.
    """

    path: Path
    format: Format
    request: FillRequest
    train: tuple[Recording, ...]

    @property
    def problem(self) -> GapProblem:
        """What a model is to fill.

        It is without unlabelled markers and results of a model of the body of which nothing is to
        be filled.
        """
        request = self.request
        wanted = match_channels(request.given, None, request.results) | request.target.any(axis=0)
        return select_channels(GapProblem(request.given, request.target, self.train), wanted)


def read_input_files(
    files: Sequence[Path], train: Sequence[Path], reading: Reading, entries: NamedEntries
) -> tuple[list[InputFile], list[str]]:
    """Return the files to fill, and why others are left out: there is nothing to fill in them.

    All of them are read, and those to fill are found to be usable.

    Parameters
    ----------
    files, train : sequence of Path
        Files to fill, and files to learn from; each file to fill is left out of the latter.
    reading : Reading
        How all of them are read.
    entries : NamedEntries
        What to fill in each file.

    Raises
    ------
    FormatError
        If a file cannot be read, or one to learn from lacks a channel of it, or has other units or
        another rate.
    UsageError
        If there is nothing to fill in any file, or nothing to fill it from.
    """
    others = {path.resolve(): reading.read(path) for path in train}
    inputs: list[InputFile] = []
    left_out: list[NothingToFillError] = []
    for path in files:
        try:
            inputs.append(_read_input_file(path, others, reading, entries))
        except NothingToFillError as error:
            left_out.append(error)
    if not inputs:
        raise left_out[0]
    return inputs, [str(error) for error in left_out]


def _read_input_file(
    path: Path, others: dict[Path, Recording], reading: Reading, entries: NamedEntries
) -> InputFile:
    file, recording = reading.format_of(path), reading.read(path)
    results = file.results(path, recording.channels)
    train = tuple(
        _match_channels(other, recording, results)
        for file, other in others.items()
        if file != path.resolve()
    )
    check_alike([recording, *train])
    return InputFile(path, file, select(recording, entries, train, results), train)


def _match_channels(other: Recording, recording: Recording, results: Sequence[str]) -> Recording:
    """Return the channels of ``recording`` from another one, which stays whole if it lacks any.

    An unlabelled marker is nobody's in particular, and a result of a model no marker: where the
    other lacks one, nothing of it shows.
    """
    units = dict(zip(recording.channels, recording.units, strict=True))
    lacking = [name for name in recording.channels if name not in other.channels]
    if not {*lacking} <= {*filter(is_unlabelled, lacking), *results}:
        return other
    hidden = np.full((len(other.times), len(lacking)), np.nan)
    padded = replace(
        other,
        values=np.hstack([other.values, hidden]),
        channels=(*other.channels, *lacking),
        units=(*other.units, *(units[name] for name in lacking)),
    )
    return padded.select(recording.channels)
