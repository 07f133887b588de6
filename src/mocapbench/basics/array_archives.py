"""Archives of arrays (.npz) that come from anybody: nothing in them is unpickled."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from zipfile import BadZipFile

from numpy.lib.npyio import NpzFile

__all__ = ["open_arrays"]


@contextmanager
def open_arrays(path: Path) -> Iterator[NpzFile]:
    """Open an archive of arrays, which are read when they are asked for.

    Unlike `numpy.load` it takes no other file for a pickled object, which it would advise to load
    unsafely.

    Raises
    ------
    ValueError
        If it is no archive.
    """
    with path.open("rb") as file:
        try:
            arrays = NpzFile(file)
        except BadZipFile as error:
            raise ValueError("a file that is no archive of arrays") from error
        with arrays:
            yield arrays
