"""The recordings of contests of motion prediction: their files, or what the database has of them.

A folder that the user names holds ``train/ACTION/ACTION_N.txt`` and ``test/ACTION/ACTION_N.txt``,
as in the folder ``cmu_mocap`` of those who made them. A recording whose file is not there is made
from the CMU database's own where it is known which one it is.
"""

from __future__ import annotations

import csv
import gzip
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import ClassVar

import numpy as np

from mocapbench.basics.path_lists import folders_of_recordings
from mocapbench.datasets.acclaim.motion import FRAME_RATE
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.cmu import CMULibrary
from mocapbench.datasets.errors import FetchError
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.library import Library
from mocapbench.datasets.recording import FrameByChannel, Recording
from mocapbench.datasets.rotations.body import (
    ROTATION_CHANNELS,
    ROTATION_UNITS,
    rotation_skeleton,
)

__all__ = ["RotationLibrary", "original_recordings"]


@cache
def original_recordings() -> Mapping[str, str]:
    """Return the key of the CMU database by that of a file, empty where it is not known."""
    table = Path(__file__).with_name("files.tsv").read_text(encoding="utf-8")
    rows = csv.DictReader(table.splitlines(), delimiter="\t")
    return {row["file"]: row["recording"] for row in rows}


class RotationLibrary(Library):
    """Recordings as rotation vectors by key, such as ``test/walking_1``.

    Parameters
    ----------
    *folders : path
        Folders with ``train`` and ``test``, or with recordings of the CMU database; without any,
        those of the environment's ``MOCAPBENCH_DATA``.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import RotationLibrary
    >>> with TemporaryDirectory() as folder:
    ...     RotationLibrary(folder).where("test/basketball_1")
    ''
    """

    layout: ClassVar[tuple[str, ...]] = ("train/*/*_[1-5].txt*", "test/*/*_1.txt*")

    def __init__(self, *folders: str | Path) -> None:
        super().__init__(*(folders or folders_of_recordings()))
        self._database = CMULibrary(*folders)

    def where(self, key: str) -> str:
        """Return the path of the file, or else of the recording that it was made from."""
        found, original = self._find(key), original_recordings()[key]
        return found or (self._database.where(original) if original else "")

    def recording(self, key: str) -> Recording:
        """Return the 117 columns of a file, its rest pose included, at 120 frames per second.

        Raises
        ------
        FileNotFoundError
            If neither the file nor the recording that it was made from is here.
        FormatError
            If it is no such file.
        DigestMismatch, AcclaimError
            If the recording that it was made from is wrong.
        """
        path = self._find(key)
        if path:
            values = _parse_rotations(_read_bytes(path), path)
            times = np.arange(len(values)) / FRAME_RATE
            return Recording(key, times, values, ROTATION_CHANNELS, ROTATION_UNITS)
        original = original_recordings()[key]
        # SciPy's rotations take .2 s to load, which whoever has the files should not pay.
        from mocapbench.datasets.rotations.recipe import rotations_of  # noqa: PLC0415

        return rotations_of(self._database.recording(original), self._database.skeleton(original))

    def skeleton(self, key: str) -> Skeleton:
        """Return the joints and what connects them, which are the same for all."""
        self._find(key)  # refuses what is no key
        return rotation_skeleton()

    def digest(self, key: str) -> str:
        """Return the SHA-256 of the file's text, or of the recording that it was made from."""
        path = self._find(key)
        if path:
            return sha256(_read_bytes(path)).hexdigest()
        return f"from {self._database.digest(original_recordings()[key])}"

    def fetch(self, key: str) -> None:
        """Download the recording that a file was made from, unless one of them is here.

        Raises
        ------
        FetchError, DigestMismatch
            See `CMULibrary.fetch`; also if it is not known from which it was made.
        """
        if self.where(key):
            return
        if advice := self.advice(key):
            raise FetchError(key, "it is not known which recording of the database it is", advice)
        self._database.fetch(original_recordings()[key])

    def advice(self, key: str) -> str:
        """Return which folder has the file, if it is not known from which recording it was made."""
        self._find(key)  # refuses what is no key
        if original_recordings()[key]:
            return ""
        return "name the folder cmu_mocap of the contest's authors with --data-dir"

    def _find(self, key: str) -> str:
        """Return the path of a file, empty if it is not here."""
        if key not in original_recordings():
            raise ValueError(f"expected a file of the contest, such as test/walking_1, got {key!r}")
        part, _, name = key.partition("/")
        path = Path(part, name.rpartition("_")[0], name)
        files = (folder / f"{path}{end}" for folder in self.folders for end in (".txt", ".txt.gz"))
        return next((str(file) for file in files if file.is_file()), "")


def _read_bytes(path: str) -> bytes:
    """Return the text of a file, which may be compressed."""
    data = Path(path).read_bytes()
    try:
        return gzip.decompress(data) if path.endswith(".gz") else data
    except (EOFError, OSError) as error:
        raise FormatError(path, "a file compressed by gzip", str(error), "copy it anew") from error


def _parse_rotations(data: bytes, path: str) -> FrameByChannel:
    """Return the columns (N, 117) of a file.

    Raises
    ------
    FormatError
        If a row does not have as many numbers, or one is not finite.
    """
    wanted, advice = f"{len(ROTATION_CHANNELS)} numbers a row", "copy the file anew"
    try:
        values = np.loadtxt(BytesIO(data), delimiter=",", ndmin=2)
    except ValueError as error:
        raise FormatError(path, wanted, str(error), advice) from error
    if values.shape[1] != len(ROTATION_CHANNELS) or len(values) < 2:
        raise FormatError(path, f"two rows or more of {wanted}", f"{values.shape}", advice)
    wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if wrong.size:
        raise FormatError(path, "finite numbers", "others", advice, int(wrong[0]) + 1)
    return values
