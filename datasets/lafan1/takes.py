"""The file ``lafan1.zip``, which holds BVH files of five subjects, such as ``walk1_subject5.bvh``.

Its licence (CC BY-NC-ND 4.0) lets nobody pass on what is made of it, and it is not downloaded: a
user gets it from the repository ``ubisoft/ubisoft-laforge-animation-dataset``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from hashlib import file_digest
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import ClassVar
from zipfile import BadZipFile, ZipFile

import numpy as np

from mocapbench.basics.path_lists import folders_of_recordings
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.digests import DigestMismatch
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.joints.bvh import BVHFormat
from mocapbench.datasets.lafan1.hierarchy import parse_hierarchy
from mocapbench.datasets.library import Library
from mocapbench.datasets.recording import Recording

__all__ = ["SUBJECTS", "LaFAN1Library"]

SUBJECTS = tuple(f"subject{number}" for number in range(1, 6))
_FILE = "lafan1.zip"
_DIGEST = "ea918082b500a5d158e9d3aa39039df04cd42e25f5c02fe8f7e88e8e9365a977"
_PAUSE = 1.0
"""Seconds between the takes of a subject, which one recording holds one after another."""
_ADVICE = "get lafan1.zip (144,051,503 bytes) from its authors anew"


class LaFAN1Library(Library):
    """Recordings of LaFAN1 by key, ``subject1`` to ``subject5``, from a file that a user has.

    A recording holds all takes of a subject in the order of their names, with a pause between.

    Parameters
    ----------
    *folders : path
        Folders, of which one has ``lafan1.zip``; without any, those of the environment's
        ``MOCAPBENCH_DATA``.
    expected : str
        The SHA-256 of the file.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import LaFAN1Library
    >>> with TemporaryDirectory() as folder:
    ...     LaFAN1Library(folder).where("subject5")
    ''
    """

    layout: ClassVar[tuple[str, ...]] = (_FILE,)

    def __init__(self, *folders: str | Path, expected: str = _DIGEST) -> None:
        super().__init__(*(folders or folders_of_recordings()))
        self.expected = expected

    def where(self, key: str) -> str:
        """Return the path of the file, an empty string if it is not here."""
        _check_key(key)
        files = (folder / _FILE for folder in self.folders)
        return next((str(file) for file in files if file.is_file()), "")

    def recording(self, key: str) -> Recording:
        """Return the channels of all takes of a subject, at 30 frames per second.

        Raises
        ------
        DigestMismatch
            If the file is another.
        FormatError
            If it is no such file, or a take of it cannot be read.
        """
        with TemporaryDirectory() as folder:
            takes = [BVHFormat().read(path) for path in self._extract_takes(key, Path(folder))]
        alike = {take.channels for take in takes}
        if len(alike) > 1:
            raise FormatError(_FILE, "one body in all takes", f"{len(alike)} in {key}", _ADVICE)
        return _join_takes(key, takes)

    def skeleton(self, key: str) -> Skeleton:
        """Return the joints of a subject, whose offsets are those of its first take.

        Raises
        ------
        DigestMismatch, FormatError
            As `recording`.
        """
        with TemporaryDirectory() as folder:
            first = next(self._extract_takes(key, Path(folder)))
            return parse_hierarchy(first.read_text(encoding="utf-8").splitlines(), first.name)

    def digest(self, key: str) -> str:
        """Return the SHA-256 of the file, verified, and the subject."""
        return f"{self._verify_file(key)} {key}"

    def advice(self, key: str) -> str:
        """Return where the file is to be had, whose licence forbids to pass it on."""
        _check_key(key)
        return (
            f"get {_FILE} from github.com/ubisoft/ubisoft-laforge-animation-dataset (git lfs), as "
            "its licence forbids to pass it on, and name its folder with --data-dir"
        )

    def _verify_file(self, key: str) -> str:
        """Return the digest of the file, once it is known to be the right one."""
        path = self.where(key)
        with Path(path).open("rb") as stream:
            got = file_digest(stream, "sha256").hexdigest()
        if got != self.expected:
            raise DigestMismatch(path, self.expected, got, _ADVICE)
        return got

    def _extract_takes(self, key: str, folder: Path) -> Iterator[Path]:
        """Yield the BVH files of a subject, each written to a folder, in the order of names."""
        self._verify_file(key)
        try:
            with ZipFile(self.where(key)) as archive:
                names = [name for name in archive.namelist() if name.endswith(f"_{key}.bvh")]
                if not names:
                    wanted = f"takes called *_{key}.bvh"
                    raise FormatError(_FILE, wanted, "none", _ADVICE)
                for name in sorted(names):
                    path = folder / PurePosixPath(name).name
                    path.write_bytes(archive.read(name))
                    yield path
        except BadZipFile as error:
            raise FormatError(_FILE, "a zip file", str(error), _ADVICE) from error


def _check_key(key: str) -> None:
    if key not in SUBJECTS:
        raise ValueError(f"expected a subject of LaFAN1, {' to '.join(SUBJECTS[::4])}, got {key!r}")


def _join_takes(key: str, takes: list[Recording]) -> Recording:
    """Return takes one after another, with a pause between."""
    times, begin = [], 0.0
    for take in takes:
        times.append(take.times - take.times[0] + begin)
        begin = float(times[-1][-1]) + _PAUSE
    values = np.concatenate([take.values for take in takes])
    return replace(takes[0], name=key, times=np.concatenate(times), values=values)
