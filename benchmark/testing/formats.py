"""Whether a format reads what it should, changes nothing that it should not, and never crashes."""

from __future__ import annotations

import random
import shutil
import warnings
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mocapbench.benchmark.testing.errors import raised_by, require, require_equal
from mocapbench.datasets import Format, FormatError, Recording, unwrap_angles
from mocapbench.datasets.recording import FrameByChannel, Mask

__all__ = ["check_format", "damage_bytes"]

_TURN = {"deg": 360.0, "rad": 2.0 * np.pi}
_N_DAMAGED = 40
_PIECES = (b"", b"\0", b"\xff\xff", b"\n", b" ", b",", b"\t", b"nan", b"-", b"_", b"1e999", b'"')


def check_format(kind: type[Format], sample: Path) -> None:
    """Check that a format reads and writes a file as `Format` promises.

    Parameters
    ----------
    kind : type
        A subclass of `Format`.
    sample : Path
        A file that it reads, with two frames or more. Files beside it are copied with it.

    Raises
    ------
    ConformanceError
        At the first thing that is wrong.
    """
    advice = "inherit from mocapbench.datasets.Format"
    subclass = isinstance(kind, type) and issubclass(kind, Format)
    require(subclass, "a subclass of mocapbench.datasets.Format", repr(kind), advice)
    with raised_by(kind.__name__, "it reads and writes the sample"), TemporaryDirectory() as folder:
        shutil.copytree(sample.parent, folder, dirs_exist_ok=True)
        copy = Path(folder, sample.name)
        _check_suffixes(kind, copy)
        _check_reading(kind(), copy)
        _check_writing(kind(), copy)
        _check_refusals(kind(), copy)
        _check_damaged(kind(), copy)


def damage_bytes(data: bytes, rng: random.Random) -> bytes:
    """Return the bytes of a file with some cut off, removed, replaced, inserted or repeated.

    Half of the files have bytes from elsewhere in them alone, of which many can still be read.
    """
    if rng.random() < 0.2:
        return data[: rng.randrange(len(data) + 1)]
    gentle = rng.random() < 0.5
    for _ in range(rng.choice([1, 2, 3]) if gentle else rng.randint(1, 8)):
        # Half of the time near the beginning, where formats say what follows.
        at = rng.randrange(min(len(data), 2048) + 1 if rng.random() < 0.5 else len(data) + 1)
        there, size = rng.randrange(len(data) + 1), rng.choice([0, 1, 2, 30])
        pieces = (*_PIECES, data[at : at + 40], bytes([rng.randrange(256)]))
        piece = data[there : there + size] if gentle else rng.choice(pieces)
        data = data[:at] + piece + data[at + size :]
    return data


def _check_suffixes(kind: type[Format], sample: Path) -> None:
    right = kind.suffixes and all(s == s.lower() and s.startswith(".") for s in kind.suffixes)
    advice = 'write suffixes = (".mine",)'
    require(right, "suffixes in lower case, each with its dot", kind.suffixes, advice)
    advice = "name a sample of this format"
    require(sample.suffix.lower() in kind.suffixes, f"one of {kind.suffixes}", sample.name, advice)


def _check_reading(format_: Format, sample: Path) -> None:
    before = sample.read_bytes()
    one, two = format_.read(sample), format_.read(sample)
    advice = "read nothing but the file"
    require_equal(one.values, two.values, "the same recording at every reading", advice)
    require(sample.read_bytes() == before, "the file as it was", "another", "do not write to it")
    timed = format_.read(sample, rate=50.0)
    expected, advice = np.arange(len(one.times)) / 50.0, "let a rate take the place of the times"
    require_equal(timed.times, expected, "a frame every 1/50 s at the rate 50", advice)


def _check_writing(format_: Format, sample: Path) -> None:
    out = sample.with_name(f"out{sample.suffix}")
    raw, recording = format_.load(sample, None), format_.read(sample)
    replaced = np.random.default_rng(0).random(raw.values.shape) < 0.2
    for mask in (np.zeros_like(replaced), replaced):
        filled = unwrap_angles(recording.hide(mask))
        filled = filled.with_values(np.where(mask, _close_by(recording), filled.values))
        format_.write(out, filled, like=sample, replaced=mask)
        again = format_.load(out, None)
        advice = "copy from the file whatever is not new"
        require_equal(again.values[~mask], raw.values[~mask], "the rest to the last digit", advice)
        _check_written(again, filled.values, mask & filled.visible)


def _close_by(recording: Recording) -> FrameByChannel:
    """Return the mean of each entry and the one before it."""
    return (recording.values + np.roll(recording.values, 1, axis=0)) / 2.0


def _check_written(again: Recording, filled: FrameByChannel, mask: Mask) -> None:
    for channel, unit in enumerate(again.units):
        rows = mask[:, channel]
        error = again.values[rows, channel] - filled[rows, channel]
        error -= _TURN[unit] * np.round(error / _TURN[unit]) if unit in _TURN else 0.0
        tolerance = 1e-3 * (1.0 + np.abs(filled[rows, channel]))
        expected, advice = (
            "what was filled, up to multiples of 360°",
            "write the values that are new",
        )
        require((np.abs(error) <= tolerance).all(), expected, f"errors {error}", advice)


def _check_refusals(format_: Format, sample: Path) -> None:
    recording, before = format_.read(sample), sample.read_bytes()
    advice = "leave `read` and `write` as `Format` has them, and override `load` and `save`"
    for path in (sample.with_suffix(".no-such-suffix"), sample):
        refused = False
        try:
            format_.write(path, recording, like=sample)
        except FormatError:
            refused = True
        require(refused, f"that {path.name} is refused for output", "a file", advice)
    require(sample.read_bytes() == before, "the file as it was", "another", advice)


def _check_damaged(format_: Format, sample: Path) -> None:
    rng, data = random.Random(0), sample.read_bytes()
    for content in (b"", *_several(data, rng)):
        sample.write_bytes(content)
        for kind, rate in ((format_, None), (format_, 50.0), (format_.with_missing_rows(), 50.0)):
            try:
                with warnings.catch_warnings(action="ignore"):
                    _fill_damaged(kind, sample, rate)
            except FormatError as error:
                parts, advice = ("expected ", ", got ", "; "), "say what to do"
                require(all(part in str(error) for part in parts), "a full message", error, advice)


def _fill_damaged(format_: Format, sample: Path, rate: float | None) -> None:
    """Read a file, and write it with something in its gaps."""
    recording, out = format_.read(sample, rate), sample.with_stem("out")
    format_.likelihoods(sample)
    filled = recording.with_values(np.nan_to_num(recording.values, nan=1.5))
    format_.write(out, filled, like=sample)
    format_.read(out, 50.0)


def _several(data: bytes, rng: random.Random) -> Iterator[bytes]:
    return (damage_bytes(data, rng) for _ in range(_N_DAMAGED))
