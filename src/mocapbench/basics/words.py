"""Words of messages: counts, names in a row, and text that a terminal may show."""

from __future__ import annotations

import re
from collections.abc import Collection

__all__ = ["encodable", "format_count", "join_names", "printable"]

_CONTROL = r"\x00-\x08\x0b-\x1f\x7f-\x9f"
_BIDIRECTIONAL = r"\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"
_UNPRINTABLE = re.compile(
    rf"""
    (?: \x1b\[ | \x9b ) [0-?]* [ -/]* [@-~]   # colours, cursor, erasing: CSI of ECMA-48
    # Titles, hyperlinks, the clipboard, with all they hold. None spans lines, so that one without
    # an end hides no message.
    | (?: \x1b[\]PX^_] | [\x90\x98\x9d-\x9f] ) [^\n{_CONTROL}]* (?: \x07 | \x1b\\ | \x9c )
    | \x1b [ -/]* [0-~]                       # character sets, reset
    | [{_CONTROL}{_BIDIRECTIONAL}]
    """,
    re.VERBOSE,
)


def format_count(count: int, noun: str, plural: str = "") -> str:
    """Return a count with its noun: "1 case", "2 cases"; an irregular ``plural`` is named."""
    return f"{count} {noun}" if count == 1 else f"{count} {plural or f'{noun}s'}"


def join_names(names: Collection[str], most: int) -> str:
    """Return names in a row, the first ``most`` of them: "a, b and 3 more"; "none" without any."""
    more = len(names) - most
    first = [*names][:most] or ["none"]
    *others, last = [*first, f"{more} more"] if more > 0 else first
    return f"{', '.join(others)} and {last}" if others else last


def printable(text: str) -> str:
    r"""Return ``text`` without escape sequences, control characters and marks of direction.

    Line feeds and tabs stay, and lone surrogates are escaped (`encodable`). Names and messages come
    from packages, files and runs of others; through them a terminal could be cleared or made to
    show a link elsewhere, and marks of direction let text be read as another.

    Examples
    --------
    >>> printable("\x1b]8;;http://elsewhere\x1b\\knn\x1b]8;;\x1b\\ \x1b[31mfailed\x1b[0m")
    'knn failed'
    """
    return encodable(_UNPRINTABLE.sub("", text))


def encodable(text: str) -> str:
    r"""Return ``text`` with lone surrogates escaped, which no file and no terminal takes.

    Python has them for the bytes of a file's name that are not UTF-8.

    Examples
    --------
    >>> encodable("T\udceate.c3d")
    'T\\udceate.c3d'
    """
    return text.encode("utf-8", "backslashreplace").decode()
