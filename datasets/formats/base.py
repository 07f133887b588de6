"""Formats of files: the class to subclass in order to add one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from math import isfinite
from pathlib import Path
from typing import ClassVar

import numpy as np

from mocapbench.basics.temporaries import final_place
from mocapbench.basics.whole_files import stage_file
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.formats.angle_wrapping import unwrap_angles, wrap_angles
from mocapbench.datasets.formats.errors import FormatError, MissingExtraError
from mocapbench.datasets.formats.memory import check_fits
from mocapbench.datasets.formats.model_outputs import model_outputs
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["Format"]


class Format(ABC):
    r"""A format of files, each with one recording.

    A subclass says which `suffixes` it has and defines `load` and `save`, which deal with the file
    as it is. `read` and `write` do what all formats share: they look at suffix and size, unwrap
    angles and wrap them again, and leave no half-written file behind.

    See Also
    --------
    CSVFormat, AcclaimFormat, C3DFormat : Formats that come with the package.

    Examples
    --------
    A format with one number a line, 30 of them a second, and a dash where there is none:

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import numpy as np
    >>> from mocapbench.datasets import Format, FormatError, Recording
    >>> class Column(Format):
    ...     suffixes = (".column",)
    ...
    ...     def load(self, path, rate):
    ...         try:
    ...             values = [float(w.replace("-", "nan")) for w in path.read_text().split()]
    ...         except ValueError as error:
    ...             raise FormatError(str(path), "numbers", str(error), "mend it") from error
    ...         times = np.arange(len(values)) / (rate or 30.0)
    ...         return Recording(path.name, times, np.reshape(values, (-1, 1)), ["height"], ["cm"])
    ...
    ...     def save(self, path, values, new, like):
    ...         words = like.read_text().split()
    ...         for frame in np.flatnonzero(new):
    ...             words[frame] = repr(float(values[frame, 0]))
    ...         path.write_text("\n".join(words))
    >>> with TemporaryDirectory() as folder:
    ...     given, out = Path(folder, "jump.column"), Path(folder, "filled.column")
    ...     _ = given.write_text("1.0 - 2.50")
    ...     jump = Column().read(given)
    ...     Column().write(out, jump.with_values([[1.0], [1.75], [2.5]]), like=given)
    ...     out.read_text().split()
    ['1.0', '1.75', '2.50']
    """

    suffixes: ClassVar[tuple[str, ...]] = ()
    """In lower case, with the dot."""
    needs: ClassVar[tuple[str, str] | None] = None
    """The package that is imported, and the extra of mocapbench that brings it."""
    memory_per_byte: ClassVar[float] = 16.0
    """Bytes of memory that reading takes for each byte of a file."""

    @abstractmethod
    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has.

        Parameters
        ----------
        path : Path
            A file of one of the suffixes, which fits in memory.
        rate : float or None
            Frames per second, in place of what the file says about its times.

        Raises
        ------
        FormatError
            If the file cannot be read. Any other ValueError and any OSError is turned into one.
        """

    @abstractmethod
    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write a copy of a file with some entries changed, and nothing else.

        Parameters
        ----------
        path : Path
            What is written, without a suffix to go by.
        values : ndarray of shape (N, D)
            Finite where ``new``; whatever they are elsewhere does not matter.
        new : ndarray of bool of shape (N, D)
            The entries to write. All others stay as they are in ``like``, to the last digit.
        like : Path
            A file that `load` has just read.

        Raises
        ------
        FormatError
            If the format cannot hold a value.
        """

    def skeleton(self, path: Path) -> Skeleton | None:
        """Return the skeleton by which the channels move; None if the format has none."""
        del path
        return None

    def results(self, path: Path, channels: Sequence[str]) -> tuple[str, ...]:
        """Return the channels that are results of a model of the body, not measured.

        They follow from the others, and are left alone where nobody names them. By default they are
        those that Plug-in Gait calls so, in any format.

        Parameters
        ----------
        path : Path
            A file that `read` has read.
        channels : sequence of str
            Its channels.
        """
        del path
        return model_outputs(channels)

    def likelihoods(self, path: Path) -> FrameByChannel | None:
        """Return how likely a file says each entry to be.

        Returns
        -------
        ndarray of shape (N, D) or None
            Of the entries that `load` returns, NaN where the file does not say it; None if the file
            says it nowhere, as in most formats.
        """
        del path
        return None

    def with_missing_rows(self) -> Format:
        """Return the format that reads frames of which a file has no row as hidden, and adds rows.

        By default it is the format itself, as most formats have all frames.
        """
        return self

    def read(self, path: str | Path, rate: float | None = None) -> Recording:
        """Return the recording of a file, under the file's name.

        Parameters
        ----------
        path : path
        rate : float or None
            Frames per second, in place of what the file says about its times; None leaves them.

        Returns
        -------
        Recording
            Entries that the file lacks are hidden. Angles are unwrapped (`unwrap_angles`). Units
            are those of the file.

        Raises
        ------
        FormatError
            If the suffix is another, a library is missing, or the file cannot be read, is malformed
            or does not fit in memory.
        """
        return unwrap_angles(self.read_as_stated(path, rate))

    def read_as_stated(self, path: str | Path, rate: float | None = None) -> Recording:
        """Return the recording with angles as they stand in the file, else as `read`.

        Raises
        ------
        FormatError
            As `read`.
        """
        path = Path(path)
        self._check_suffix(path)
        if self.needs is not None and find_spec(self.needs[0]) is None:
            raise MissingExtraError(str(path), *self.needs)
        if rate is not None and not (isfinite(rate) and rate > 0):
            raise FormatError(str(path), "a positive rate", f"{rate:g}", "name frames per second")
        with _plain_errors(path):
            size = path.stat().st_size
            check_fits(str(path), size, self.memory_per_byte * size)
            recording = self.load(path, rate)
            _check_texts(path.name, recording)
            return recording

    def write(
        self,
        path: str | Path,
        filled: Recording,
        like: str | Path,
        replaced: Mask | None = None,
        stated: Recording | None = None,
    ) -> None:
        """Write a copy of a file whose gaps are filled.

        Parameters
        ----------
        path : path
            A file to write, other than ``like``.
        filled : Recording
            The frames and channels of ``read(like)``; what is hidden in it stays as the file has
            it. Angles are wrapped as the file keeps them.
        like : path
            The file that was read.
        replaced : ndarray of bool of shape (N, D) or None
            The entries that were filled; None stands for those that the file lacks. All others stay
            as they are, to the last digit.
        stated : Recording or None
            What `read_as_stated` has returned of ``like``; None has it read again.

        Raises
        ------
        FormatError
            If frames or channels are not those of the file, the format cannot hold a value,
            ``path`` is ``like``, or one of them cannot be read or written.
        """
        path, like = Path(path), Path(like)
        named = final_place(path)  # in messages: several files may be written together
        self._check_suffix(named)
        if path.resolve() == like.resolve():
            advice = "choose another name or folder"
            raise FormatError(str(named), "another file than the one read", "the same", advice)
        raw = stated or self.read_as_stated(like, rate=1.0)  # a rate, as times are not written
        _check_shape(filled, raw, named)
        new = (~raw.visible if replaced is None else np.asarray(replaced, dtype=bool)) & (
            filled.visible
        )
        values = wrap_angles(filled.values, raw.hide(new), new)
        with _plain_errors(named), stage_file(path) as temporary:
            self.save(temporary, values, new, like)

    def _check_suffix(self, path: Path) -> None:
        if path.suffix.lower() not in self.suffixes:
            raise FormatError(
                str(path),
                f"a file called {' or '.join(f'*{suffix}' for suffix in self.suffixes)}",
                f"{path.suffix!r}",
                "name a file of this format",
            )


def _check_texts(file: str, recording: Recording) -> None:
    """Refuse names and units that no table and no page could hold: halves of characters."""
    for text in (*recording.channels, *recording.units):
        if any("\ud800" <= character <= "\udfff" for character in text):
            advice = "rename the channel, or export the recording again with text in UTF-8"
            raise FormatError(file, "names and units of whole characters", ascii(text), advice)


def _check_shape(filled: Recording, raw: Recording, path: Path) -> None:
    if filled.channels != raw.channels or len(filled.times) != len(raw.times):
        raise FormatError(
            str(path),
            f"the {len(raw.times)} frames and {len(raw.channels)} channels of {raw.name}",
            f"{len(filled.times)} frames and {len(filled.channels)} channels, or other names",
            "fill the recording that was read from it",
        )


@contextmanager
def _plain_errors(path: Path) -> Iterator[None]:
    """Turn errors of the system and of values into a `FormatError`."""
    try:
        yield
    except FormatError as error:
        error.file = str(path) if error.file == path.name else error.file
        raise
    except OSError as error:
        advice = "check its name and permissions"
        got = error.strerror or str(error)
        raise FormatError(str(path), "a file that can be used", got, advice) from error
    except ValueError as error:
        advice = "export the recording again"
        raise FormatError(str(path), "a recording", str(error), advice) from error
