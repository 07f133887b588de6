"""Where recordings come from: addresses such as ``cmu:35_02`` and the libraries behind them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

import pooch

from mocapbench.datasets.acclaim.errors import AcclaimError
from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.cmu import CMULibrary
from mocapbench.datasets.digests import DigestMismatch
from mocapbench.datasets.gait import GaitLibrary
from mocapbench.datasets.library import Library, RecordingStatus, RecordingUnavailable

__all__ = ["Archive", "open_archive"]


class Archive:
    """Recordings by address, ``LIBRARY:SUBJECT_TRIAL``; a malformed one raises ValueError.

    Parameters
    ----------
    libraries : mapping of str to Library
        By the name that precedes the colon.
    """

    def __init__(self, libraries: Mapping[str, Library]) -> None:
        self.libraries = dict(libraries)

    def available(self, uri: str) -> bool:
        """Return whether the recording can be read without a network."""
        library, key = self._resolve(uri)
        return bool(library.where(key))

    def read(self, uri: str) -> Motion:
        """Return a recording, verified; nothing is downloaded.

        Raises
        ------
        RecordingUnavailable
            If it is not on this machine.
        DigestMismatch, AcclaimError
            If it is here and wrong.
        """
        library, key = self._here(uri)
        return library.read(key)

    def recording(self, uri: str):
        return self.read(uri).recording(uri)

    def skeleton(self, uri: str):
        return self.read(uri).skeleton

    def digest(self, uri: str) -> str:
        """Return what identifies the content of a recording, verified.

        Raises
        ------
        RecordingUnavailable
            If it is not on this machine.
        DigestMismatch
            If it is here and wrong.
        """
        library, key = self._here(uri)
        return library.digest(key)

    @staticmethod
    def fetch_command(*uris: str) -> str:
        """Return the command that gets the recordings."""
        return " ".join(["mocapbench data fetch", *(uri.rpartition(":")[2] for uri in uris)])

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

    def status(self, uris: Iterable[str]) -> list[RecordingStatus]:
        """Return what is here, without reading it."""
        return [self._status(uri) for uri in uris]

    def verify(self, uris: Iterable[str]) -> list[RecordingStatus]:
        """Return what is here and whether it is right, after reading all of it."""
        return [self._verify(uri) for uri in uris]

    def _status(self, uri: str) -> RecordingStatus:
        library, key = self._resolve(uri)
        where = library.where(key)
        return RecordingStatus(uri, "available" if where else "missing", where, "")

    def _verify(self, uri: str) -> RecordingStatus:
        status = self._status(uri)
        try:
            self.read(uri)
            return status._replace(state="verified", digest=self.digest(uri))
        except RecordingUnavailable:
            return status
        except (AcclaimError, DigestMismatch) as problem:
            return status._replace(state="wrong", where=str(problem))

    def _here(self, uri: str) -> tuple[Library, str]:
        library, key = self._resolve(uri)
        if not library.where(key):
            raise RecordingUnavailable(uri, self.fetch_command(uri))
        return library, key

    def _resolve(self, uri: str) -> tuple[Library, str]:
        name, _, key = uri.partition(":")
        if name not in self.libraries:
            known = ", ".join(self.libraries)
            raise ValueError(f"expected LIBRARY:SUBJECT_TRIAL, LIBRARY one of {known}; got {uri!r}")
        return self.libraries[name], key


def open_archive(
    data_dir: str | Path | None = None, cache_dir: str | Path | None = None
) -> Archive:
    """Return the archive of all libraries: ``cmu`` and ``gait``.

    Parameters
    ----------
    data_dir : path or None
        Folder with the CMU database's ``subjects/``; None stands for the environment's
        ``MOCAPBENCH_DATA``, if it is set.
    cache_dir : path or None
        Folder for downloads; None stands for ``MOCAPBENCH_CACHE``, else the user's cache.
    """
    folder = data_dir or os.environ.get("MOCAPBENCH_DATA")
    cache = cache_dir or os.environ.get("MOCAPBENCH_CACHE") or pooch.os_cache("mocapbench")
    cmu = CMULibrary(Path(folder) if folder else None, Path(cache))
    return Archive({"cmu": cmu, "gait": GaitLibrary()})
