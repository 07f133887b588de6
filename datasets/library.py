"""Libraries of recordings: the class to subclass in order to add one, and the user's folders."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import ClassVar

from mocapbench.basics.path_lists import named_folders
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.digests import content_digest
from mocapbench.datasets.errors import FetchError, SkeletonUnavailable
from mocapbench.datasets.recording import Recording

__all__ = ["Library", "named_folders"]


class Library(ABC):
    """A collection of recordings, each with a key.

    A subclass defines `where` and `recording`. It overrides `fetch` if it can download, else
    `advice` if there is more to do than putting files where it looks for them; `skeleton` if it has
    skeletons, and `digest` if it knows a cheaper or stricter way to identify its content. An
    `Archive` gives access to recordings of several libraries.

    Keys are any non-empty text without a colon; a library that is stricter raises ValueError for a
    malformed key in every method.

    Parameters
    ----------
    *folders : path
        Folders of recordings that the user named, in the order in which they are searched; a
        library may ignore them.

    Attributes
    ----------
    folders : tuple of Path
        The folders.
    layout : tuple of str
        Patterns of the files that it reads below a folder that the user names, such as
        ``"subjects/*/*.amc"``. A library that reads such files sets it, so that a folder without
        any is refused; by default it reads none.

    See Also
    --------
    Archive : Finds recordings by addresses such as ``waves:2``.
    CMULibrary, GaitLibrary : The libraries that come with the package.

    Examples
    --------
    A library of sine waves, whose keys are angular frequencies:

    >>> import numpy as np
    >>> from mocapbench.datasets import Archive, Library, Recording
    >>> class Waves(Library):
    ...     def where(self, key):
    ...         return "generated" if key.isdigit() else ""
    ...
    ...     def recording(self, key):
    ...         times = np.arange(4) / 30
    ...         return Recording(key, times, np.sin(int(key) * times)[:, None], ["wave"], [""])
    >>> archive = Archive({"waves": Waves()})
    >>> archive.recording("waves:2").channels
    ('wave',)
    >>> archive.available("waves:two")
    False
    """

    layout: ClassVar[tuple[str, ...]] = ()

    def __init__(self, *folders: str | Path) -> None:
        self.folders: tuple[Path, ...] = tuple(map(Path, folders))

    @abstractmethod
    def where(self, key: str) -> str:
        """Return where a recording is: a path or ``"generated"``; an empty string if not here."""

    @abstractmethod
    def recording(self, key: str) -> Recording:
        """Return a recording for which `where` is not empty, without using the network.

        Raises
        ------
        ValueError
            If its file is malformed, or is not the one it should be.
        """

    def digest(self, key: str) -> str:
        """Return what identifies the content of a recording for which `where` is not empty.

        Results are stored under this digest, so it must change whenever the recording does.

        Returns
        -------
        str
            The SHA-256 of the recording's times, values, channels and units.

        Raises
        ------
        ValueError
            As `recording`.
        """
        return content_digest(self.recording(key))

    def fetch(self, key: str) -> None:
        """Make a recording available; one that is here already is left alone.

        Raises
        ------
        FetchError
            If that is impossible. The base class cannot download: any recording that is not here.
        """
        if not self.where(key):
            why = f"{type(self).__name__} cannot download recordings"
            raise FetchError(key, why, self.advice(key))

    def advice(self, key: str) -> str:  # noqa: ARG002
        """Return how a user gets a recording that `fetch` cannot download; empty if it can."""
        if type(self).fetch is not Library.fetch:
            return ""
        return "put it where the library looks for it, or name its folder with --data-dir"

    def renew(self, key: str) -> None:
        """Take what is here as right from now on, if another copy was recorded as right.

        The base class records nothing of what it saw, and makes the recording available.

        Raises
        ------
        FetchError
            As `fetch`.
        """
        self.fetch(key)

    def skeleton(self, key: str) -> Skeleton:
        """Return the skeleton of a recording for which `where` is not empty.

        Raises
        ------
        SkeletonUnavailable
            If the library has none: always, in the base class.
        """
        raise SkeletonUnavailable(key, type(self).__name__)
