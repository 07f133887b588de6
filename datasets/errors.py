"""Errors of looking for recordings: not here, no skeleton, not to be downloaded."""

from __future__ import annotations

__all__ = ["FetchError", "RecordingUnavailable", "ServerUnreachable", "SkeletonUnavailable"]


class RecordingUnavailable(LookupError):  # noqa: N818
    """A recording that is not on this machine.

    Parameters
    ----------
    uri : str
        Address of the recording.
    remedy : str
        How to get it.
    """

    def __init__(self, uri: str, remedy: str) -> None:
        super().__init__(uri, remedy)
        self.uri = uri
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.uri} is not on this machine; {self.remedy}"


class SkeletonUnavailable(LookupError):  # noqa: N818
    """A recording of a library that has no skeleton for it.

    Parameters
    ----------
    key : str
        Key of the recording.
    library : str
        Name of the library's class.
    """

    def __init__(self, key: str, library: str) -> None:
        super().__init__(key, library)
        self.key = key
        self.library = library

    def __str__(self) -> str:
        return (
            f"{self.library} has no skeleton for recording {self.key!r}; "
            "a library that has skeletons overrides Library.skeleton"
        )


class FetchError(RuntimeError):
    """A recording or file that could not be fetched.

    Parameters
    ----------
    what : str
        The address of the file, or the key of the recording.
    why : str
        What happened.
    remedy : str
        What to do.
    """

    def __init__(self, what: str, why: str, remedy: str) -> None:
        super().__init__(what, why, remedy)
        self.what = what
        self.why = why
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.what}: {self.why}; {self.remedy}"


class ServerUnreachable(FetchError):  # noqa: N818
    """The server does not answer, so that other downloads from it would fail too."""
