"""The model behind a command: recordings go out in files, and predictions come back."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np

from mocapbench.baselines import FrameImputer, Prediction
from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.recordings import by_content
from mocapbench.basics.numbers import real_numbers
from mocapbench.basics.scratch import scratch_folder
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.programs.exchange import EXCHANGES, NamedArrays
from mocapbench.benchmark.programs.running import ProgramError, run_program
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["SEED", "CommandModel"]

SEED = "MOCAPBENCH_SEED"
"""The variable of the environment with the seed of what the program draws at random."""
_CLOSE = 1e-4
"""By how much of a channel's largest value a visible entry may be rounded."""


class CommandModel(FrameImputer):
    """A program that fills gaps: each subclass is one, as its TOML file says.

    Parameters
    ----------
    random_state : int, default=0
        Seed of what the program draws at random.

    Attributes
    ----------
    channels_, units_ : tuple of str
        Of the recordings given to `fit`.
    recordings_ : tuple of Recording
        These recordings in an order that does not depend on the one in which they were given; none
        if the program learns in `fit`.
    names_ : frozenset of str
        Their names.
    learnt_ : mapping of str to bytes
        The files that the program has left in `fit`, by their paths.
    """

    command: ClassVar[tuple[str, ...]]
    """The program and its first arguments."""
    folder: ClassVar[Path]
    """Where it runs: the folder of its TOML file."""
    exchange: ClassVar[str]
    """The name of one of `EXCHANGES`."""
    variables: ClassVar[Mapping[str, str]] = {}
    """Of its environment: those with which it finds its packages."""
    same_as: ClassVar[str] = ""
    """The name of the model that it is with another seed, if it is."""

    def __init__(self, random_state: int = 0) -> None:
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Have the program learn, or keep the recordings for when it fills others.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        ProgramError, TimeoutError, MemoryError
            See `mocapbench.benchmark.programs.running.run_program`.
        """
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.names_: frozenset[str] = frozenset(recording.name for recording in checked)
        self.recordings_: tuple[Recording, ...] = () if self.learns_in_fit else checked
        self.learnt_: Mapping[str, bytes] = self._learn(checked) if self.learns_in_fit else {}
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return what the program predicts.

        Raises
        ------
        ValueError
            If channels differ, or the program fills no new recording and one is new.
        ProgramError
            If a prediction is not there or not as expected, or the program fails.
        TimeoutError, MemoryError
            See `mocapbench.benchmark.programs.running.run_program`.
        """
        check_given(self, recordings)
        self._require_known(recordings)
        if not recordings:
            return []
        with _make_folder("train", "given", "model", "filled") as folder:
            self._write(folder / "train", self.recordings_)
            paths = self._write(folder / "given", recordings)
            for path, content in self.learnt_.items():
                (folder / "model" / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / "model" / path).write_bytes(content)
            said = self._run("fill", folder)
            read = [self._read(folder / "filled" / path.name, said) for path in paths]
        return [
            _make_prediction(each, arrays, said)
            for each, arrays in zip(recordings, read, strict=True)
        ]

    def _learn(self, recordings: Sequence[Recording]) -> Mapping[str, bytes]:
        with _make_folder("train", "model") as folder:
            self._write(folder / "train", recordings)
            self._run("fit", folder)
            model = folder / "model"
            files = sorted(path for path in model.rglob("*") if path.is_file())
            return {path.relative_to(model).as_posix(): path.read_bytes() for path in files}

    def _require_known(self, recordings: Sequence[Recording]) -> None:
        if "fills new recordings" in self.provides:
            return
        for recording in recordings:
            if recording.name not in self.names_:
                raise ValueError(
                    f"recording {recording.name!r}: expected one that was given to fit, got "
                    'another; if the program can fill it, add "fills new recordings" to provides'
                )

    def _write(self, folder: Path, recordings: Sequence[Recording]) -> list[Path]:
        """Write a file for each recording, whose names have the order of the recordings."""
        exchange = EXCHANGES[self.exchange]
        paths = [folder / f"{k:04d}{exchange.suffix}" for k in range(1, len(recordings) + 1)]
        for path, recording in zip(paths, recordings, strict=True):
            exchange.write(path, _list_arrays(recording))
        return paths

    def _run(self, step: str, folder: Path) -> str:
        """Have the program do one step in a folder of files, and return what it said."""
        words = (*self.command, step)
        variables = {**self.variables, SEED: str(self.random_state)}
        return run_program(words, folder, self.folder, variables)

    def _read(self, path: Path, said: str) -> NamedArrays:
        """Return the arrays of a prediction, ``mean`` or ``samples`` among them."""
        exchange, place = EXCHANGES[self.exchange], f"{path.parent.name}/{path.name}"
        if not path.exists():
            raise ProgramError(
                f"expected the program to write {place}, got no such file; {exchange.advice}{said}"
            )
        try:
            arrays = exchange.read(path)
        except Exception as error:  # whatever a library raises of a file of another kind
            raise ProgramError(
                f"{place}: expected named arrays of numbers, got: {reason(error)}; "
                f"{exchange.advice}{said}"
            ) from error
        if arrays.keys().isdisjoint({"mean", "samples"}):
            names = ", ".join(sorted(arrays)) or "none"
            raise ProgramError(
                f"{place}: expected an array called mean or samples, got {names}; "
                f"{exchange.advice}{said}"
            )
        return arrays


@contextmanager
def _make_folder(*names: str) -> Iterator[Path]:
    """Make a folder of temporary files with these folders in it, which goes with the context."""
    with scratch_folder() as folder:
        for name in names:
            (folder / name).mkdir()
        yield folder


def _list_arrays(recording: Recording) -> NamedArrays:
    """Return what a program is told of a recording."""
    return {
        "values": recording.values,
        "times": recording.times,
        "channels": np.array(recording.channels, dtype=str),
        "units": np.array(recording.units, dtype=str),
        "name": np.array([recording.name], dtype=str),
    }


def _make_prediction(recording: Recording, arrays: NamedArrays, said: str) -> Prediction:
    """Return the prediction that a program has made of a recording.

    Raises
    ------
    ProgramError
        If it is not as expected.
    """
    try:
        mean, deviation = _read_moments(arrays, recording.values.shape)
        _require_visible(recording, mean)
        hidden = ~recording.visible
        _require_all(np.isfinite(mean[hidden]), "a number", mean[hidden])
        if deviation is not None:
            _require_all(deviation[hidden] > 0.0, "a std above 0", deviation[hidden])
    except ValueError as error:
        raise ProgramError(f"recording {recording.name!r}: {error}{said}") from error
    return Prediction.around(recording, mean, None if deviation is None else deviation**2)


def _read_moments(
    arrays: NamedArrays, shape: tuple[int, ...]
) -> tuple[FrameByChannel, FrameByChannel | None]:
    """Return the mean and the standard deviation of a prediction, or of its samples."""
    if "samples" in arrays:
        samples = _require_shape("samples", np.atleast_3d(arrays["samples"]), shape)
        return samples.mean(axis=0), samples.std(axis=0, ddof=1) if len(samples) > 1 else None
    mean = _require_shape("mean", arrays["mean"], shape)
    return mean, _require_shape("std", arrays["std"], shape) if "std" in arrays else None


def _require_shape(what: str, array: Any, shape: tuple[int, ...]) -> FrameByChannel:
    numbers = real_numbers(what, array)
    expected = (*numbers.shape[:1], *shape) if what == "samples" else shape
    if numbers.shape != expected:
        draws = "(draws, frames, channels)" if what == "samples" else "(frames, channels)"
        raise ValueError(f"expected {what} of shape {expected} {draws}, got {numbers.shape}")
    return numbers


def _require_visible(recording: Recording, mean: FrameByChannel) -> None:
    """Refuse other values where entries are visible, which tell that frames are out of order."""
    seen = recording.visible
    size = np.fmax.reduce(np.abs(recording.values), axis=0, initial=0.0)
    near = np.abs(mean - recording.values) <= _CLOSE * size
    _require_all(near[seen], "visible values as they were given", mean[seen])


def _require_all(right: Any, expected: str, got: FrameByChannel) -> None:
    """Refuse entries that are not as expected, and show the first of them."""
    wrong = np.flatnonzero(~right)
    if wrong.size:
        raise ValueError(
            f"expected {expected} at all {right.size} entries, got others at {wrong.size}, "
            f"first {got[wrong[0]]:g}"
        )
