"""In which encoding a text of somebody else is, where nothing says so.

Text is UTF-8 if all of it decodes so, which text of another encoding hardly ever does by chance.
Else it is what programs on Windows write in Western Europe and America: Windows-1252, or, if it has
one of the five bytes that this leaves undefined, Latin-1, in which every byte is a character. Each
of the three gives back the same bytes when the text is encoded again.
"""

from __future__ import annotations

import codecs
from contextlib import suppress
from pathlib import Path
from string import printable

__all__ = ["MARK", "decode_text", "encoding_of", "foreign_encoding"]

MARK = "\ufeff"
"""The byte order mark, as text."""

_MARKS = {  # that of UTF-32 begins with that of UTF-16, and comes first
    codecs.BOM_UTF32_LE: "utf-32-le",
    codecs.BOM_UTF32_BE: "utf-32-be",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}
_STRICT = ("utf-8", "cp1252")
_ANY = "latin-1"
_CHUNK = 2**16
_NULS = {1: "UTF-16", 3: "UTF-32"}
"""Encodings by the NUL bytes that stand beside each letter of English."""
_EBCDIC = "cp037"
_KEYS = frozenset(printable + "\x85")  # also the end of a line in EBCDIC
_LEAST_SHARE = 0.9  # of such characters in text


def decode_text(data: bytes) -> str:
    r"""Return bytes of one byte a character, or of UTF-8, as text.

    Examples
    --------
    >>> from mocapbench.datasets.encoding import decode_text
    >>> decode_text("Tête".encode()), decode_text(b"T\xeate")
    ('Tête', 'Tête')
    """
    for encoding in _STRICT:
        with suppress(UnicodeDecodeError):
            return data.decode(encoding)
    return data.decode(_ANY)


def encoding_of(path: Path) -> str:
    """Return the encoding of a text file, as its byte order mark says or as its bytes allow."""
    with path.open("rb") as file:
        start = file.read(4)
    for mark, encoding in _MARKS.items():
        if start.startswith(mark):
            return encoding
    return next((encoding for encoding in _STRICT if _is_in(path, encoding)), _ANY)


def foreign_encoding(start: bytes) -> str:
    """Return the encoding in which the first bytes of a file are, if it is one of those refused.

    These are UTF-16 and UTF-32, which a byte order mark should name, and EBCDIC, of mainframes.

    Examples
    --------
    >>> from mocapbench.datasets.encoding import foreign_encoding
    >>> [foreign_encoding("time,hip".encode(one)) for one in ("utf-16-le", "cp500", "ascii")]
    ['UTF-16', 'EBCDIC', '']
    """
    beside = round(start.count(0) / max(len(start) - start.count(0), 1))
    if beside in _NULS:
        return _NULS[beside]
    ebcdic, latin = (_share_of_keys(start, encoding) for encoding in (_EBCDIC, _ANY))
    return "EBCDIC" if ebcdic >= _LEAST_SHARE > latin else ""


def _share_of_keys(data: bytes, encoding: str) -> float:
    """Return the share of characters that a keyboard of English has."""
    return sum(one in _KEYS for one in data.decode(encoding)) / max(len(data), 1)


def _is_in(path: Path, encoding: str) -> bool:
    """Return whether a file decodes, of which only a part is in memory at a time."""
    with path.open(encoding=encoding, newline="") as file, suppress(UnicodeDecodeError):
        while file.read(_CHUNK):
            pass
        return True
    return False
