"""What a library of recordings is: a place that resolves keys such as ``35_02`` to motions."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from typing import NamedTuple

from mocapbench.datasets.acclaim.motion import Motion

__all__ = ["Library", "RecordingStatus", "RecordingUnavailable", "split_key"]

_KEY = re.compile(r"([0-9]{2,3})_([0-9]{2})")


class RecordingUnavailable(LookupError):  # noqa: N818
    """A recording that is not on this machine.

    Parameters
    ----------
    uri : str
        The recording asked for.
    command : str
        The command that gets it.
    """

    def __init__(self, uri: str, command: str) -> None:
        super().__init__(uri, command)
        self.uri = uri
        self.command = command

    def __str__(self) -> str:
        return f"{self.uri} is not on this machine; get it with: {self.command}"


class RecordingStatus(NamedTuple):
    """One row of ``mocapbench data``."""

    uri: str
    state: str
    """``available``, ``missing``, ``verified`` or ``wrong``."""
    where: str
    """A path, ``generated`` or, where something is wrong, what."""
    digest: str
    """Of the whole recording, where it was computed."""


class Library(ABC):
    """Recordings by key, ``SUBJECT_TRIAL``; a malformed key raises ValueError everywhere."""

    @abstractmethod
    def where(self, key: str) -> str:
        """Return where the recording is, or an empty string if it would have to be fetched."""

    @abstractmethod
    def read(self, key: str) -> Motion:
        """Return an available recording, verified; the network is never asked."""

    @abstractmethod
    def digest(self, key: str) -> str:
        """Return what identifies the content of an available recording, verified."""

    @abstractmethod
    def fetch(self, key: str) -> None:
        """Make the recording available; what is here and right is left alone."""


def split_key(key: str) -> tuple[str, str]:
    """Return subject and trial of a key such as ``35_02``.

    Raises
    ------
    ValueError
        If the key is malformed.
    """
    match = _KEY.fullmatch(key)
    if match is None:
        raise ValueError(f"expected a recording as SUBJECT_TRIAL, such as 35_02, got {key!r}")
    return match[1], match[2]
