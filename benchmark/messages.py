"""What records and messages say of exceptions that others raised."""

from __future__ import annotations

import traceback

__all__ = ["reason", "shorten_text", "traceback_of"]

_MESSAGE = 2_000
_TRACEBACK = 20_000
"""Characters of a text that are kept at most; of a longer one, its beginning and its end."""


def reason(error: BaseException) -> str:
    """Return the type and the message of ``error``; the type alone if the message raises."""
    kind = type(error).__name__
    try:
        return shorten_text(f"{kind}: {error}", _MESSAGE)
    except BaseException:
        return f"{kind}, whose message cannot be read"


def traceback_of(error: BaseException) -> str:
    """Return the traceback of ``error``, as Python shows it."""
    return shorten_text("".join(traceback.format_exception(error)), _TRACEBACK)


def shorten_text(text: str, most: int) -> str:
    """Return ``text``; of a longer one than ``most`` characters, its beginning and its end."""
    if len(text) <= most:
        return text
    half = most // 2
    return f"{text[:half]} … {text[-half:]}"
