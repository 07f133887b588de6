"""The recordings of a run, each read once and kept as a file that every worker loads.

To read an original again for every job would cost more than most baselines' fits.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Hashable, Mapping
from functools import lru_cache
from pathlib import Path

from mocapbench.basics.whole_files import atomic_write, write_bytes
from mocapbench.benchmark.messages import reason
from mocapbench.datasets import Archive, Library, Recording, Skeleton, SkeletonUnavailable

__all__ = ["Spool", "SpooledArchive"]

_KEPT = 8
"""Recordings that a process keeps; what a worker keeps counts as memory of each of its jobs."""
_MOST_DERIVED = 48 << 20
"""Bytes that a process keeps of what was derived from recordings: 300 excerpts of eight seconds."""


_Content = tuple[Recording, Skeleton | None]
_derived: dict[tuple[Hashable, ...], Recording] = {}
"""By the file, the function and its arguments; what was asked for last comes last."""


class Spool:
    """A folder of recordings that belongs to one run.

    Parameters
    ----------
    folder : Path
        Where the files are; each is named by the address and the digest of its recording.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._unreadable: dict[str, str] = {}

    def add(self, archive: Archive, digests: Mapping[str, str]) -> None:
        """Read those recordings that are not here yet.

        One that cannot be read is left out: the job that needs it says why.

        Parameters
        ----------
        archive : Archive
            Where they come from.
        digests : mapping of str to str
            Their digests by address.
        """
        for uri, digest in digests.items():
            path = self.path(uri, digest)
            if not path.exists():
                try:
                    content = archive.recording(uri), _skeleton(archive, uri)
                except Exception as error:
                    self._unreadable[uri] = reason(error)
                    continue
                with atomic_write(path) as file:
                    pickle.dump(content, file, protocol=pickle.HIGHEST_PROTOCOL)

    def load(self, uri: str, digest: str) -> _Content | None:
        """Return a recording and its skeleton, or None if they are not here.

        The process keeps the last few that were loaded.
        """
        path = self.path(uri, digest)
        return _content(path) if path.exists() else None

    def files(self, digests: Mapping[str, str]) -> tuple[Path, ...]:
        """Return the files of those recordings that are here."""
        paths = (self.path(uri, digest) for uri, digest in digests.items())
        return tuple(path for path in paths if path.exists())

    def unreadable(self, digests: Mapping[str, str]) -> tuple[str, ...]:
        """Return why those recordings that could not be read could not."""
        return tuple(reason for uri, reason in self._unreadable.items() if uri in digests)

    def receive(self, name: str, content: bytes) -> None:
        """Keep a file of another spool, under its name, unless it is here already."""
        if not (self.folder / name).exists():
            write_bytes(self.folder / name, content)

    def path(self, uri: str, digest: str) -> Path:
        """Return the file of a recording."""
        return self.folder / hashlib.sha256(f"{uri}\0{digest}".encode()).hexdigest()


@lru_cache(maxsize=_KEPT)
def _content(path: Path) -> _Content:
    content: _Content = pickle.loads(path.read_bytes())
    return content


def _skeleton(archive: Archive, uri: str) -> Skeleton | None:
    try:
        return archive.skeleton(uri)
    except SkeletonUnavailable:
        return None


class SpooledArchive(Archive):
    """An archive that takes from a spool what is there.

    Parameters
    ----------
    libraries : mapping of str to Library
        For all else.
    spool : Spool
    digests : mapping of str to str
        The digests, by address, of the recordings wanted.
    """

    def __init__(
        self, libraries: Mapping[str, Library], spool: Spool, digests: Mapping[str, str]
    ) -> None:
        super().__init__(libraries)
        self.spool = spool
        self.digests = digests

    def recording(self, uri: str) -> Recording:
        """Return a recording, named by its address; see `Archive.recording`."""
        content = self._load_spooled(uri)
        return super().recording(uri) if content is None else content[0]

    def skeleton(self, uri: str) -> Skeleton:
        """Return the skeleton of a recording; see `Archive.skeleton`."""
        content = self._load_spooled(uri)
        if content is None:
            return super().skeleton(uri)
        _, skeleton = content
        if skeleton is None:  # so its library said, where the recording was read
            library, key = self._resolve(uri)
            raise SkeletonUnavailable(key, type(library).__name__)
        return skeleton

    def derive(
        self, uri: str, function: Callable[..., Recording], *arguments: Hashable
    ) -> Recording:
        """Return what a function makes of a recording; see `Archive.derive`.

        The process keeps the last ones that were asked for.
        """
        if uri not in self.digests:
            return super().derive(uri, function, *arguments)
        key = (self.spool.path(uri, self.digests[uri]), function, arguments)
        made = _derived.pop(key, None)
        if made is None:
            made = super().derive(uri, function, *arguments)
            _make_room(made.values.nbytes)
        _derived[key] = made
        return made

    def _load_spooled(self, uri: str) -> _Content | None:
        return self.spool.load(uri, self.digests[uri]) if uri in self.digests else None


def _make_room(n_bytes: int) -> None:
    """Forget what was asked for longest ago, as far as there is no room for so many bytes more."""
    left = _MOST_DERIVED - n_bytes - sum(each.values.nbytes for each in _derived.values())
    while left < 0 and _derived:
        left += _derived.pop(next(iter(_derived))).values.nbytes
