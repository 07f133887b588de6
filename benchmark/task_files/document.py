"""A TOML file whose errors name the file, the line and the key."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from typing import Any, TypeVar

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.foreign_files import ForeignFileError, decode_toml
from mocapbench.benchmark.messages import shorten_text

__all__ = ["Document", "TaskFileError", "line_of"]

T = TypeVar("T")

_SHOWN = 200
"""Characters of a value in a message."""
_TOKEN = re.compile(
    r"""
    "{3} (?: \\. | [^\\] )*? "{3,5} | '{3} .*? '{3,5}            # texts of several lines
    | " (?: \\. | [^"\\\n] )* " | ' [^'\n]* ' | \# [^\n]*       # texts and comments
    | [\[\]{}\n]
    """,
    re.VERBOSE | re.DOTALL,
)
"""What decides where an entry of TOML ends."""


class TaskFileError(UsageError):
    """A task file that asks for what cannot be; the message says where and what to write."""


@dataclass(frozen=True)
class Document:
    """A task file.

    Parameters
    ----------
    file : str
        Its name, for messages.
    text : str
        The TOML.
    """

    file: str
    text: str

    @cached_property
    def values(self) -> Mapping[str, Any]:
        """What the file says.

        Raises
        ------
        TaskFileError
            If it is no TOML; the message has the line.
        """
        try:
            document: dict[str, Any] = decode_toml(self.text, dict[str, Any])
        except ForeignFileError as error:
            raise TaskFileError(
                f"{self.file}: expected TOML, got: {error}; write lines such as folds = 5, "
                'texts in quotes, with / between folders, and lists such as ["hip.*", "knee.*"]'
            ) from error
        return document

    def error(self, key: str, expected: str, got: object, advice: str) -> TaskFileError:
        """Return the error of one key, such as ``hide.runs``, with the line on which it stands."""
        line = line_of(self.text, key)
        place = self.file if line is None else f"{self.file}, line {line}"
        return TaskFileError(f"{place}, key {key}: expected {expected}, got {got}; {advice}")

    def get(self, key: str) -> Any:
        """Return the value of a key such as ``hide.runs``, or None where there is none."""
        value: Any = self.values
        for name in key.split("."):
            value = value.get(name) if isinstance(value, Mapping) else None
        return value

    def read(
        self, key: str, default: T, fits: Callable[[Any], bool], expected: str, example: str
    ) -> T:
        """Return the value of a key.

        Parameters
        ----------
        key : str
        default : object
            Its value where the file does not have it.
        fits : callable
            Whether a value is as expected.
        expected, example : str
            What a value is, and one, both for messages.

        Raises
        ------
        TaskFileError
            If the value does not fit.
        """
        value = self.get(key)
        if value is None:
            return default
        if not fits(value):
            name = key.rpartition(".")[2]
            got = shorten_text(repr(value), _SHOWN)
            raise self.error(key, expected, got, f"write for example {name} = {example}")
        return value  # type: ignore[no-any-return]  # as ``fits`` says

    def require_known(self, table: str, known: Collection[str]) -> None:
        """Refuse keys of a table, or of the file if ``table`` is empty, that are not ``known``.

        Raises
        ------
        TaskFileError
            That suggests the nearest.
        """
        held = self.get(table) if table else self.values
        for name in held:
            if name not in known:
                near = get_close_matches(name, known, n=1)
                advice = f"did you mean {near[0]}?" if near else "remove it"
                key = f"{table}.{name}" if table else name
                raise self.error(key, f"one of {', '.join(known)}", repr(name), advice)


def line_of(text: str, key: str) -> int | None:
    r"""Return the line on which a key of a TOML document stands, or a table above it; else None.

    That of an entry is the line on which it begins. Every part of the document is read once.

    Parameters
    ----------
    text : str
        A whole TOML document.
    key : str
        With dots between tables.

    Examples
    --------
    >>> from mocapbench.benchmark.task_files.document import line_of
    >>> line_of('files = [\n  "a.csv",\n]\n\n[hide]\nfraction = 0.2\n', "hide.fraction")
    6
    >>> line_of('files = [\n  "a.csv",\n]', "files")
    1
    """
    header = ""
    for line, entry in _split_entries(text):
        header, beside = (entry, "") if entry.lstrip().startswith("[") else (header, entry)
        if _has(Document("", f"{header}\n{beside}\n").values, key):
            return line
    above = key.rpartition(".")[0]
    return line_of(text, above) if above else None


def _split_entries(text: str) -> Iterator[tuple[int, str]]:
    """Yield the entries, headers of tables, comments and empty lines of TOML, with their lines.

    An entry ends with the line on which no bracket is open.
    """
    start, first, line, depth = 0, 1, 1, 0
    for token in _TOKEN.finditer(f"{text}\n"):
        line += token[0].count("\n")
        depth += (token[0] in "[{") - (token[0] in "]}")
        if token[0] == "\n" and depth == 0:
            yield first, text[start : token.start()]
            start, first = token.end(), line


def _has(values: Mapping[str, Any], key: str) -> bool:
    name, _, below = key.partition(".")
    if name not in values:
        return False
    return not below or (isinstance(values[name], Mapping) and _has(values[name], below))
