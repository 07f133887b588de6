"""Digests of files and recordings, and the registry of the right ones.

Digests of files do not depend on line ends.
"""

from __future__ import annotations

import json
import re
import warnings
from collections.abc import Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

from mocapbench.datasets.recording import Recording

__all__ = [
    "DigestMismatch",
    "DigestRegistry",
    "UnregisteredDigestWarning",
    "content_digest",
    "read_digests",
    "with_unix_line_ends",
]

_ROW = re.compile(r"^(\S+)\t([0-9a-f]{64})$", re.MULTILINE)
_DAMAGED = "the file is damaged or another edition: remove it and fetch it again"


class DigestMismatch(ValueError):  # noqa: N818
    """A file whose digest is not the expected one.

    Parameters
    ----------
    file : str
        Its path or address.
    expected, got : str
        SHA-256 of the content with line ends normalised to LF.
    remedy : str
        What to do.
    """

    def __init__(self, file: str, expected: str, got: str, remedy: str = _DAMAGED) -> None:
        super().__init__(file, expected, got, remedy)
        self.file = file
        self.expected = expected
        self.got = got
        self.remedy = remedy

    def __str__(self) -> str:
        return (
            f"{self.file}: expected SHA-256 (of LF lines) {self.expected}, got {self.got}; "
            f"{self.remedy}"
        )


class UnregisteredDigestWarning(UserWarning):
    """A file that no registry lists was accepted, and its digest pinned."""


def content_digest(recording: Recording) -> str:
    """Return the SHA-256 of a recording's channels, units, times and values; not of its name."""
    names = json.dumps([recording.channels, recording.units]).encode()
    return sha256(names + recording.times.tobytes() + recording.values.tobytes()).hexdigest()


def with_unix_line_ends(data: bytes) -> bytes:
    """Return the bytes with CRLF replaced by LF; copies of the database differ only in these."""
    return data.replace(b"\r\n", b"\n")


def read_digests(path: Path) -> dict[str, str]:
    """Return the digests that a table of path and SHA-256 lists; none if it does not exist."""
    if not path.exists():
        return {}
    return dict(_ROW.findall(path.read_text(encoding="utf-8")))


class DigestRegistry:
    """Known digests of files, and those recorded when a file without one was first seen.

    Parameters
    ----------
    known : mapping of str to str
        SHA-256 by relative path.
    pins : Path
        Table of the digests accepted so far on this machine.
    """

    def __init__(self, known: Mapping[str, str], pins: Path) -> None:
        self.known = known
        self.pins = pins

    def check(self, path: str, data: bytes, file: str) -> None:
        """Verify the content of ``file``, which claims to be ``path``; pin it if it is new.

        Raises
        ------
        DigestMismatch
            If its digest is not the known or pinned one.

        Warns
        -----
        UnregisteredDigestWarning
            If there was neither.
        """
        got = sha256(with_unix_line_ends(data)).hexdigest()
        pinned = read_digests(self.pins)
        if path in self.known:
            _compare(file, self.known[path], got, _DAMAGED)
        elif path in pinned:
            _compare(file, pinned[path], got, self._first_seen(path))
        else:
            self._pin(path, got, file)

    def _first_seen(self, path: str) -> str:
        return (
            "no digest is registered, and this is not the file that was first seen here: if it is "
            f"the right one, delete the line of {path} in {self.pins}"
        )

    def _pin(self, path: str, digest: str, file: str) -> None:
        warnings.warn(
            f"{file}: no digest is registered for {path}; accepted as {digest} "
            f"and from now on expected (recorded in {self.pins})",
            UnregisteredDigestWarning,
            stacklevel=2,
        )
        with suppress(OSError):  # in a cache that is not writeable nothing can be pinned
            self.pins.parent.mkdir(parents=True, exist_ok=True)
            with self.pins.open("a", encoding="utf-8") as stream:
                stream.write(f"{path}\t{digest}\n")


def _compare(file: str, expected: str, got: str, remedy: str) -> None:
    if got != expected:
        raise DigestMismatch(file, expected, got, remedy)
