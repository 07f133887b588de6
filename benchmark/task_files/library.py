"""The library of users' own recordings: files in a folder, by their paths in it."""

from __future__ import annotations

from pathlib import Path

from mocapbench.basics.words import encodable
from mocapbench.benchmark.files import is_path_below
from mocapbench.benchmark.formats import format_for, read_measured
from mocapbench.datasets import FormatError, Library, Recording, Skeleton, SkeletonUnavailable
from mocapbench.datasets.digests import content_digest

__all__ = ["SCHEME", "FolderLibrary", "address_of", "require_addressable"]

SCHEME = "files"
"""The name under which the library is registered."""
_RATE = "?rate="


class FolderLibrary(Library):
    """Recordings of your own, in files of any registered format below a folder that you name.

    A key is the path of a file below the folder, with slashes: ``monday/walk.csv``. Where the times
    of a file are missing or wrong, it ends in the frames per second: ``walk.csv?rate=120``.

    Parameters
    ----------
    *folders : path
        See `Library`. The first folder that has the file counts.
    """

    def __init__(self, *folders: str | Path) -> None:
        super().__init__(*folders)
        self._digests: dict[str, str] = {}

    def where(self, key: str) -> str:
        """Return the path of the file, or an empty string; never one outside the folders."""
        path = _split(key)[0]
        if not is_path_below(path):
            return ""
        files = (folder / path for folder in self.folders)
        return next((str(file) for file in files if file.is_file()), "")

    def recording(self, key: str) -> Recording:
        """Return a recording, its missing entries hidden and its angles unwrapped.

        Results of a model of the body and markers without names are left out.

        Raises
        ------
        FormatError
            If it cannot be read.
        """
        path = self.where(key)
        recording = read_measured(path, _split(key)[1])
        self._digests[key] = content_digest(recording)
        return recording

    def digest(self, key: str) -> str:
        """Return the SHA-256 of what the file says; see `Library.digest`.

        The file is read once for each library, as many cases ask for the digest of one recording.
        """
        if key not in self._digests:
            self.recording(key)
        return self._digests[key]

    def skeleton(self, key: str) -> Skeleton:
        """Return the skeleton of a recording; see `Library.skeleton`.

        Raises
        ------
        SkeletonUnavailable
            If its format has none.
        """
        path = self.where(key)
        skeleton = format_for(path).skeleton(Path(path))
        if skeleton is None:
            raise SkeletonUnavailable(key, type(self).__name__)
        return skeleton


def address_of(path: str, rate: float | None) -> str:
    """Return the address of the file at ``path`` below the folder, read at ``rate`` if any.

    Raises
    ------
    FormatError
        As `require_addressable`.
    """
    require_addressable(path)
    return f"{SCHEME}:{path}" + ("" if rate is None else f"{_RATE}{rate:g}")


def require_addressable(path: str) -> None:
    """Refuse a path below the folder that no address and no task file can hold.

    Raises
    ------
    FormatError
        If it has what separates the parts of an address, or bytes that are not UTF-8.
    """
    if ":" in path or _RATE in path or encodable(path) != path:
        expected = f"a file whose path is UTF-8, without ':' and '{_RATE}'"
        raise FormatError(encodable(path), expected, ascii(path), "rename it")


def _split(key: str) -> tuple[str, float | None]:
    path, found, rate = key.rpartition(_RATE)
    return (path, float(rate)) if found else (key, None)
