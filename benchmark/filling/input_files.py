"""The user's input files: those to fill, and those to learn from."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.faults import Fault, find_faults_at_gaps
from mocapbench.benchmark.filling.gaps import Gap, find_gaps
from mocapbench.benchmark.filling.requests.refusals import NothingToFillError
from mocapbench.benchmark.filling.requests.request import FillRequest, NamedEntries, select
from mocapbench.benchmark.recording_checks.reading import Reading
from mocapbench.datasets import Format, FormatError, Recording, check_alike
from mocapbench.datasets.formats.strays import find_unmeasured

__all__ = ["InputFile", "compose_request", "read_input_files"]


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
    stated : Recording
        The recording as the file has it.
    remarks : tuple of str
        What is to be said of missing values in the files.
    spikes : tuple of Gap
        Entries to fill that were hidden as spikes.
    """

    path: Path
    format: Format
    request: FillRequest
    stated: Recording
    remarks: tuple[str, ...] = ()
    spikes: tuple[Gap, ...] = ()

    @cached_property
    def faults(self) -> list[Fault]:
        """The faults that touch a gap to fill."""
        return find_faults_at_gaps(self.request)


def read_input_files(
    files: Sequence[Path],
    train: Sequence[Path],
    reading: Reading,
    entries: NamedEntries,
    check: Callable[[InputFile], None],
) -> tuple[list[InputFile], list[Exception]]:
    """Return the files to fill, and why others cannot be filled or need not be.

    Parameters
    ----------
    files, train : sequence of Path
        Files to fill, and files to learn from; each file to fill is left out of the latter.
    reading : Reading
        How all of them are read.
    entries : NamedEntries
        What to fill in each file.
    check : callable
        Refuses a file for other reasons, by an error.

    Returns
    -------
    inputs : list of InputFile
    refused : list of Exception
        A `NothingToFillError` where nothing is to be filled.

    Raises
    ------
    FormatError
        If a file to learn from cannot be read, or as the first file where none can be filled.
    UsageError
        As the first file where none can be filled.
    """
    others = {path.resolve(): reading.read_without_spikes(path) for path in train}
    inputs: list[InputFile] = []
    refused: list[Exception] = []
    for path in files:
        try:
            source = _read_input_file(path, others, reading, entries)
            check(source)
            inputs.append(source)
        except (FormatError, UsageError, OSError) as error:
            refused.append(error)
    if not inputs:
        raise min(refused, key=lambda error: isinstance(error, NothingToFillError))
    return inputs, refused


def _read_input_file(
    path: Path,
    others: Mapping[Path, tuple[Recording, tuple[str, ...]]],
    reading: Reading,
    entries: NamedEntries,
) -> InputFile:
    file = reading.format_of(path)
    stated = file.read_as_stated(path, reading.rate)
    recording, remarks = reading.interpret(path, stated)
    results = file.results(path, recording.channels)
    spikes, said_of_spikes = reading.find_spikes(recording, results)
    recording = recording.hide(spikes)
    train = {other: told for other, told in others.items() if other != path.resolve()}
    of_train = (f"{other.name}: {text}" for other, (_, said) in train.items() for text in said)
    try:
        request = compose_request(recording, entries, [one for one, _ in train.values()], results)
    except NothingToFillError as error:
        raise NothingToFillError(f"{error}{reading.suggest_likelihoods(path)}") from None
    said = (*remarks, *said_of_spikes, *of_train)
    return InputFile(path, file, request, stated, said, find_gaps(spikes & request.target))


def compose_request(
    recording: Recording, entries: NamedEntries, others: Sequence[Recording], results: Sequence[str]
) -> FillRequest:
    """Return the request of filling a recording, for which models learn from others besides.

    Parameters
    ----------
    recording : Recording
    entries : NamedEntries
    others : sequence of Recording
        With the channels of the recording, in any order.
    results : sequence of str
        Channels of results of a model of the body.

    Raises
    ------
    FormatError
        If another recording has other channels, units or frames per second.
    UsageError
        If nothing is to be filled, or what is named is not there.
    """
    alike = tuple(_match_channels(one, recording, results) for one in others)
    check_alike([recording, *alike])
    return select(recording, entries, alike, results)


def _match_channels(other: Recording, recording: Recording, results: Sequence[str]) -> Recording:
    """Return the channels of ``recording`` from another one, which stays whole if it lacks any.

    An unlabelled marker is nobody's in particular, and a result of a model no marker: where the
    other lacks one, nothing of it shows.
    """
    units = dict(zip(recording.channels, recording.units, strict=True))
    lacking = [name for name in recording.channels if name not in other.channels]
    if not {*lacking} <= find_unmeasured(lacking, results):
        return other
    hidden = np.full((len(other.times), len(lacking)), np.nan)
    padded = replace(
        other,
        values=np.hstack([other.values, hidden]),
        channels=(*other.channels, *lacking),
        units=(*other.units, *(units[name] for name in lacking)),
    )
    return padded.select(recording.channels)
