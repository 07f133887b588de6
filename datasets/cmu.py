"""The CMU Graphics Lab Motion Capture Database: in a folder, in the cache, or to be downloaded.

The original files have the same paths as on the server: joint angles are in Acclaim files such as
``subjects/35/35.asf`` and ``subjects/35/35_02.amc``, the markers that they were made from in
``subjects/35/35_02.c3d``. The user's folders are searched in order and before the cache, and only
`CMULibrary.fetch` downloads.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from mocapbench.basics.cache import find_cache
from mocapbench.basics.path_lists import folders_of_recordings
from mocapbench.datasets.acclaim.errors import AcclaimError
from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.acclaim.motion_reader import read_motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.acclaim.skeleton_reader import read_skeleton
from mocapbench.datasets.digests import (
    DigestMismatch,
    DigestRegistry,
    comparable_bytes,
    read_digests,
)
from mocapbench.datasets.errors import FetchError, SkeletonUnavailable
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.markers.c3d import C3DFormat
from mocapbench.datasets.keys import MARKERS, split_key
from mocapbench.datasets.library import Library
from mocapbench.datasets.recording import Recording

if TYPE_CHECKING:
    from mocapbench.datasets.download import Downloader

__all__ = ["CMU_ACKNOWLEDGEMENT", "CMU_URL", "CMULibrary", "registered_digests"]

CMU_URL = "http://mocap.cs.cmu.edu/"
"""Where the CMU Motion Capture Database is found."""

_DIVERSE = frozenset(f"subjects/35/35_{trial}.amc" for trial in (13, 14, 19, 23, 24, 25, 26))
"""Recordings of which there are copies that hold every 4th frame and interpolate the others."""

CMU_ACKNOWLEDGEMENT = (
    "The data used in this project was obtained from mocap.cs.cmu.edu. "
    "The database was created with funding from NSF EIA-0196217."
)


def registered_digests() -> dict[str, str]:
    """Return the known SHA-256 of the database's files, by path below its root."""
    return read_digests(Path(__file__).with_name("cmu_digests.tsv"))


_File = tuple[Path, bytes]
"""A file and its content."""


class CMULibrary(Library):
    """Recordings of the CMU database by key, ``SUBJECT_TRIAL``, and their markers with ``.c3d``.

    Parameters
    ----------
    *folders : path
        Folders with the database's ``subjects/``, which are read and never written; without any,
        those of the environment's ``MOCAPBENCH_DATA``.
    cache_dir : path or None
        Where downloads and the digests of unregistered files are kept; None stands for the
        environment's ``MOCAPBENCH_CACHE``, else for the user's cache.
    base_url : str
        Address of the database.
    known : mapping of str to str or None
        Digests by relative path; None stands for those that ship with the package.
    retries : int
        Further tries after a failed download.
    backoff : float
        Seconds before the second retry, doubled for each further one.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import CMULibrary
    >>> with TemporaryDirectory() as folder:
    ...     CMULibrary(folder, cache_dir=folder).where("35_02")
    ''
    """

    layout: ClassVar[tuple[str, ...]] = (
        "subjects/*/*.asf",
        "subjects/*/*.amc",
        "subjects/*/*.c3d",
    )

    def __init__(
        self,
        *folders: str | Path,
        cache_dir: str | Path | None = None,
        base_url: str = CMU_URL,
        known: Mapping[str, str] | None = None,
        retries: int = 4,
        backoff: float = 0.5,
    ) -> None:
        super().__init__(*(folders or folders_of_recordings()))
        self.cache_dir: Path = find_cache(cache_dir)
        self.digests: DigestRegistry = DigestRegistry(
            registered_digests() if known is None else known,
            self.cache_dir / "digests.tsv",
            _DIVERSE,
        )
        self.base_url: str = base_url
        self.retries: int = retries
        self.backoff: float = backoff

    def where(self, key: str) -> str:
        """Return the path of the .amc or .c3d file; empty unless all its files are here."""
        found = [self._find(path) for path in _paths(key)]
        return "" if None in found else str(found[-1])

    def recording(self, key: str) -> Recording:
        """Return all channels of the motion, or the coordinates of all markers.

        Raises
        ------
        FileNotFoundError, DigestMismatch, AcclaimError
            As `motion`.
        FormatError
            If a .c3d file cannot be parsed.
        """
        return _parse_files(key, self._read_intact_files(key))

    def motion(self, key: str) -> Motion:
        """Return the motion, from files whose digests were verified.

        Raises
        ------
        FileNotFoundError
            If a file is not here.
        DigestMismatch
            If a file is not the registered or pinned one.
        AcclaimError
            If a file cannot be parsed.
        SkeletonUnavailable
            If it is a recording of markers.
        """
        (skeleton_file, _), (motion_file, _) = self._read_acclaim_files(key)
        return read_motion(motion_file, read_skeleton(skeleton_file))

    def skeleton(self, key: str) -> Skeleton:
        """Return the subject's skeleton, from a file whose digest was verified.

        Raises
        ------
        FileNotFoundError, DigestMismatch, AcclaimError, SkeletonUnavailable
            As `motion`.
        """
        (skeleton_file, _), _ = self._read_acclaim_files(key)
        return read_skeleton(skeleton_file)

    def digest(self, key: str) -> str:
        """Return the SHA-256 of the .c3d, or of the .asf and the .amc with LF as line ends."""
        files = self._read_intact_files(key)
        return sha256(b"".join(comparable_bytes(str(p), data) for p, data in files)).hexdigest()

    def fetch(self, key: str) -> None:
        """Download the files that are not here, and those in the cache that are wrong.

        Raises
        ------
        FetchError
            If the server does not deliver a file, or delivers one that is no motion; or if one in
            the user's folder is none.
        DigestMismatch
            If a downloaded file, or one in the user's folder, is not the registered one.
        """
        for path in _paths(key):
            self._discard_wrong_download(key, path)
            if self._find(path) is None:
                check = partial(self.digests.check, path, renewal=_renewal(key))
                self._downloader().fetch(path, check)
        try:
            self._read_intact_files(key)
        except (AcclaimError, FormatError) as problem:
            self._discard_new_downloads(key)
            raise FetchError(
                key,
                f"expected a skeleton and a motion, or markers, got {problem}",
                "try again later, or name a folder that holds the recordings with --data-dir",
            ) from problem

    def renew(self, key: str) -> None:
        """Take the files that are here, or those of the server, as right from now on.

        Files with a registered digest stay as they must be.

        Raises
        ------
        FetchError, DigestMismatch
            As `fetch`.
        """
        self.digests.forget(_paths(key))
        self.fetch(key)

    def _downloader(self) -> Downloader:
        # Its libraries take .1 s and 3 MB, which whoever downloads nothing should not pay.
        from mocapbench.datasets.download import Downloader  # noqa: PLC0415

        return Downloader(self.base_url, self.cache_dir, retries=self.retries, backoff=self.backoff)

    def _list_folders(self) -> tuple[Path, ...]:
        return (*self.folders, self.cache_dir)

    def _find(self, path: str) -> Path | None:
        files = (folder / path for folder in self._list_folders())
        return next((file for file in files if file.is_file()), None)

    def _read_acclaim_files(self, key: str) -> Sequence[_File]:
        """Return the skeleton's file and the motion's.

        Raises
        ------
        SkeletonUnavailable
            If the recording is of markers.
        """
        if key.endswith(MARKERS):
            raise SkeletonUnavailable(key, type(self).__name__)
        return self._read_intact_files(key)

    def _read_intact_files(self, key: str) -> Sequence[_File]:
        """Return the files; what nobody has seen before is recorded once all could be parsed."""
        found = [(path, *self._read_intact_file(key, path)) for path in _paths(key)]
        files = [file for _, file, _ in found]
        new = [(path, file) for path, file, is_new in found if is_new]
        if new:
            _parse_files(key, files)
        for path, (file, data) in new:
            self.digests.record(path, data, str(file))
        return files

    def _read_intact_file(self, key: str, path: str) -> tuple[_File, bool]:
        """Return a file, and whether nobody has seen its content before."""
        file = self._find(path)
        if file is None:
            raise FileNotFoundError(
                f"{path} is in none of {', '.join(map(str, self._list_folders()))}"
            )
        data = file.read_bytes()
        return (file, data), self.digests.check(path, data, str(file), _renewal(key))

    def _discard_wrong_download(self, key: str, path: str) -> None:
        try:
            self._read_intact_file(key, path)
        except FileNotFoundError:
            return
        except DigestMismatch as problem:
            if self.cache_dir not in Path(problem.file).parents:
                raise
            Path(problem.file).unlink()

    def _discard_new_downloads(self, key: str) -> None:
        for path in _paths(key):
            (file, _), is_new = self._read_intact_file(key, path)
            if is_new and self.cache_dir in file.parents:
                file.unlink()


def _paths(key: str) -> Sequence[str]:
    """Return the paths of the files of a recording below the database's root."""
    subject, _ = split_key(key.removesuffix(MARKERS))
    if key.endswith(MARKERS):
        return (f"subjects/{subject}/{key}",)
    return f"subjects/{subject}/{subject}.asf", f"subjects/{subject}/{key}.amc"


def _parse_files(key: str, files: Sequence[_File]) -> Recording:
    """Return the recording of a skeleton and a motion, or of markers alone."""
    (*skeletons, (last, _)) = files
    if not skeletons:
        return replace(C3DFormat().read(last), name=key)
    return read_motion(last, read_skeleton(skeletons[0][0])).recording(key)


def _renewal(key: str) -> str:
    return f"mocapbench data renew {key}"
