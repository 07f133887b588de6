"""Text without what a terminal obeys rather than shows."""

from __future__ import annotations

import re

__all__ = ["printable"]

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


def printable(text: str) -> str:
    r"""Return ``text`` without escape sequences, control characters and marks of direction.

    Line feeds and tabs stay. Names and messages come from packages, files and runs of others;
    through them a terminal could be cleared or made to show a link elsewhere, and marks of
    direction let text be read as another.

    Examples
    --------
    >>> printable("\x1b]8;;http://elsewhere\x1b\\knn\x1b]8;;\x1b\\ \x1b[31mfailed\x1b[0m")
    'knn failed'
    """
    return _UNPRINTABLE.sub("", text)
