"""Digests of files and recordings, and the registry of the right ones.

Digests of files of text do not depend on line ends.
"""

from __future__ import annotations

import json
import re
import warnings
from collections.abc import Collection, Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

from mocapbench.basics.whole_files import write_text
from mocapbench.datasets.recording import Recording

__all__ = [
    "DigestMismatch",
    "DigestRegistry",
    "UnregisteredDigestWarning",
    "comparable_bytes",
    "content_digest",
    "read_digests",
]

_ROW = re.compile(r"^(\S+)\t([0-9a-f]{64})$", re.MULTILINE)


_BINARY = (".c3d",)
_REMOVE = "the file is damaged or another edition: remove it and fetch it again"


class DigestMismatch(ValueError):  # noqa: N818
    """A file whose digest is not the expected one.

    Parameters
    ----------
    file : str
        Its path or address.
    expected, got : str
        SHA-256 of the content with line ends normalised to LF.
    remedy : str, default="the file is damaged or another edition: …"
        What to do.
    """

    def __init__(self, file: str, expected: str, got: str, remedy: str = _REMOVE) -> None:
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
    """A file that no registry lists was accepted."""

    of_many = "files without a registered digest, accepted and recorded"
    """What a command says of all but the first, before their number."""


def content_digest(recording: Recording) -> str:
    """Return the SHA-256 of a recording's channels, units, times and values; not of its name."""
    names = json.dumps([recording.channels, recording.units]).encode()
    return sha256(names + recording.times.tobytes() + recording.values.tobytes()).hexdigest()


def comparable_bytes(path: str, data: bytes) -> bytes:
    """Return what copies of a file share: of text all but CRLF and LF, of other files every byte.

    Parameters
    ----------
    path : str
        Whose suffix says which it is.
    data : bytes
    """
    return data if path.endswith(_BINARY) else data.replace(b"\r\n", b"\n")


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
    diverse : collection of str
        Relative paths of files of which different copies are in use: whichever comes is accepted.
    """

    def __init__(self, known: Mapping[str, str], pins: Path, diverse: Collection[str] = ()) -> None:
        self.known = known
        self.pins = pins
        self.diverse = diverse

    def check(self, path: str, data: bytes, file: str, renewal: str) -> bool:
        """Return whether the content of ``file``, which claims to be ``path``, is new.

        New is what nothing is known of, where no other content is expected.

        Parameters
        ----------
        path : str
        data : bytes
        file : str
            A path or an address, for messages.
        renewal : str
            The command that records its digest anew.

        Raises
        ------
        DigestMismatch
            If its digest is neither new nor the known or recorded one.
        """
        known = self.known.get(path)
        expected, got = known or read_digests(self.pins).get(path), _digest(path, data)
        if expected is None or got == expected or path in self.diverse:
            return got != expected
        if known:
            raise DigestMismatch(file, expected, got)
        raise DigestMismatch(
            file,
            expected,
            got,
            f"expected is the first copy that this machine saw ({self.pins}); if this one is "
            f"right, take it from now on with: {renewal}",
        )

    def record(self, path: str, data: bytes, file: str) -> None:
        """Expect this content from now on, unless different copies are in use.

        Warns
        -----
        UnregisteredDigestWarning
            Always.
        """
        digest = _digest(path, data)
        diverse = path in self.diverse
        from_now_on = "not pinned: different copies are in use" if diverse else "now expected"
        warnings.warn(
            f"{file}: no digest is registered for {path}; accepted as {digest} "
            f"(recorded in {self.pins}) and {from_now_on}",
            UnregisteredDigestWarning,
            stacklevel=2,
        )
        with suppress(OSError):  # in a cache that is not writeable nothing can be recorded
            self.pins.parent.mkdir(parents=True, exist_ok=True)
            with self.pins.open("a", encoding="utf-8") as stream:
                stream.write(f"{path}\t{digest}\n")

    def forget(self, paths: Collection[str]) -> None:
        """Forget which content of files was recorded when they were first seen."""
        recorded = read_digests(self.pins)
        if recorded.keys() & set(paths):
            kept = {path: digest for path, digest in recorded.items() if path not in paths}
            write_text(self.pins, "".join(f"{path}\t{digest}\n" for path, digest in kept.items()))


def _digest(path: str, data: bytes) -> str:
    return sha256(comparable_bytes(path, data)).hexdigest()
