"""Where recordings come from: addresses such as ``cmu:35_02`` and the libraries behind them."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.cmu import CMULibrary
from mocapbench.datasets.errors import RecordingUnavailable
from mocapbench.datasets.generated.gait import GaitLibrary
from mocapbench.datasets.library import Library
from mocapbench.datasets.recording import Recording

__all__ = ["Archive", "RecordingStatus", "open_archive"]

_DEFAULT = "cmu:"
"""What ``mocapbench data`` puts before a key without a library."""


class RecordingStatus(NamedTuple):
    """One row of ``mocapbench data``."""

    uri: str
    state: str
    """``available``, ``missing``, ``verified`` or ``wrong``."""
    where: str
    """A path or ``generated``; the error message if the state is ``wrong``."""
    digest: str
    """Of the whole recording; an empty string unless the state is ``verified``."""


class Archive:
    """Recordings of several libraries by address, ``LIBRARY:KEY``.

    Every method raises ValueError for a malformed address or an unknown library.

    Parameters
    ----------
    libraries : mapping of str to Library
        By the name that precedes the colon.

    See Also
    --------
    open_archive : An archive of the libraries that come with the package.

    Examples
    --------
    >>> from mocapbench.datasets import Archive, GaitLibrary
    >>> archive = Archive({"gait": GaitLibrary()})
    >>> archive.recording("gait:01_01").values.shape
    (331, 62)
    >>> archive.digest("gait:01_01")
    'gait-1:01_01'
    """

    def __init__(self, libraries: Mapping[str, Library]) -> None:
        self.libraries: dict[str, Library] = dict(libraries)

    def available(self, uri: str) -> bool:
        """Return whether the recording can be read without a network."""
        library, key = self._resolve(uri)
        return bool(library.where(key))

    def recording(self, uri: str) -> Recording:
        """Return a recording, verified and named by its address; nothing is downloaded.

        Raises
        ------
        RecordingUnavailable
            If it is not on this machine.
        DigestMismatch
            If it is here and is not the registered one.
        AcclaimError, ValueError
            If it is here and malformed.
        """
        library, key = self._here(uri)
        return replace(library.recording(key), name=uri)

    def skeleton(self, uri: str) -> Skeleton:
        """Return the skeleton of a recording; nothing is downloaded.

        Raises
        ------
        RecordingUnavailable
            If the recording is not on this machine.
        SkeletonUnavailable
            If its library has no skeletons.
        DigestMismatch, AcclaimError
            If the skeleton is here and wrong.
        """
        library, key = self._here(uri)
        return library.skeleton(key)

    def derive(
        self, uri: str, function: Callable[..., Recording], *arguments: Hashable
    ) -> Recording:
        """Return ``function(archive, uri, *arguments)``, which the archive may have kept.

        Parameters
        ----------
        uri : str
        function : callable
            Reads the recording and its skeleton, and nothing else. One that is defined in a module
            is known again; what is defined anew each time is computed anew.
        *arguments
            Texts, numbers and the like.

        Raises
        ------
        Exception
            Whatever the function raises.
        """
        return function(self, uri, *arguments)

    def digest(self, uri: str) -> str:
        """Return what identifies the content of a recording, verified.

        Raises
        ------
        RecordingUnavailable
            If it is not on this machine.
        DigestMismatch
            If it is here and is not the registered one.
        """
        library, key = self._here(uri)
        return library.digest(key)

    @staticmethod
    def fetch_command(*uris: str) -> str:
        """Return the command that gets the recordings."""
        return shlex.join(
            ["mocapbench", "data", "fetch", *(u.removeprefix(_DEFAULT) for u in uris)]
        )

    def advice(self, uri: str) -> str:
        """Return how a user gets a recording that cannot be downloaded; empty if it can."""
        library, key = self._resolve(uri)
        return library.advice(key)

    def fetch(self, uris: Iterable[str]) -> list[RecordingStatus]:
        """Make recordings available; those that are here and right are left alone.

        Raises
        ------
        FetchError, DigestMismatch
            At the first that fails; what came before it stays, so that a second call resumes.
        """
        uris = list(uris)
        for library, key in map(self._resolve, uris):
            library.fetch(key)
        return self.verify(uris)

    def renew(self, uri: str) -> None:
        """Take a recording that is here, or that can be had, as right from now on.

        Raises
        ------
        FetchError, DigestMismatch
            If there is none, or it is not the registered one.
        """
        library, key = self._resolve(uri)
        library.renew(key)

    def status(self, uris: Iterable[str]) -> list[RecordingStatus]:
        """Return which recordings are here, without reading them."""
        return [self._status(uri) for uri in uris]

    def verify(self, uris: Iterable[str]) -> list[RecordingStatus]:
        """Return which recordings are here and whether they are right, after reading them."""
        return [self._verify(uri) for uri in uris]

    def _status(self, uri: str) -> RecordingStatus:
        library, key = self._resolve(uri)
        where = library.where(key)
        return RecordingStatus(uri, "available" if where else "missing", where, "")

    def _verify(self, uri: str) -> RecordingStatus:
        status = self._status(uri)
        try:
            self.recording(uri)
            return status._replace(state="verified", digest=self.digest(uri))
        except RecordingUnavailable:
            return status
        except (ValueError, OSError) as problem:
            return status._replace(state="wrong", where=str(problem))

    def _here(self, uri: str) -> tuple[Library, str]:
        library, key = self._resolve(uri)
        if not library.where(key):
            remedy = library.advice(key) or f"get it with: {self.fetch_command(uri)}"
            raise RecordingUnavailable(uri, remedy)
        return library, key

    def _resolve(self, uri: str) -> tuple[Library, str]:
        name, _, key = uri.partition(":")
        if name not in self.libraries or not key or ":" in key:
            known = ", ".join(self.libraries)
            raise ValueError(
                f"expected LIBRARY:KEY, LIBRARY one of {known} and KEY without a colon; got {uri!r}"
            )
        return self.libraries[name], key


def open_archive(*folders: str | Path, cache_dir: str | Path | None = None) -> Archive:
    """Return an archive of the libraries that come with the package, ``cmu`` and ``gait``.

    Parameters
    ----------
    *folders : path
        Folders with the CMU database's ``subjects/``; without any, those of the environment's
        ``MOCAPBENCH_DATA``.
    cache_dir : path or None
        Folder for downloads; None stands for the environment's ``MOCAPBENCH_CACHE``, else for the
        user's cache.

    Returns
    -------
    Archive
        Whose addresses are ``cmu:SUBJECT_TRIAL``, with ``.c3d`` for its markers, and
        ``gait:SUBJECT_TRIAL``.

    See Also
    --------
    CMULibrary, GaitLibrary : The two libraries.

    Examples
    --------
    Synthetic gait needs neither files nor a network:

    >>> from mocapbench.datasets import open_archive
    >>> walk = open_archive().recording("gait:01_01")
    >>> walk.name, len(walk.times), walk.channels[:3]
    ('gait:01_01', 331, ('root.tx', 'root.ty', 'root.tz'))
    """
    return Archive({"cmu": CMULibrary(*folders, cache_dir=cache_dir), "gait": GaitLibrary()})
