"""A TOML file whose errors name the file, the line and the key."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from typing import Any, TypeVar

from mocapbench.benchmark.errors import UsageError

__all__ = ["Document", "TaskFileError", "line_of"]

T = TypeVar("T")


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
            return tomllib.loads(self.text)
        except tomllib.TOMLDecodeError as error:
            raise TaskFileError(
                f"{self.file}: expected TOML, got: {error}; write lines such as folds = 5, "
                'texts in quotes, and lists such as ["hip.*", "knee.*"]'
            ) from error

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
            raise self.error(key, expected, repr(value), f"write for example {name} = {example}")
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

    TOML is read from its beginning, one line longer at a time: a key stands on the first line after
    the last beginning without it. So it does not matter how the file is written.

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
    lines, before = text.splitlines(), 0
    for end in range(1, len(lines) + 1):
        try:
            beginning = Document("", "\n".join(lines[:end]) + "\n").values
        except TaskFileError:  # in the middle of a value of several lines
            continue
        if _has(beginning, key):
            return before + 1
        before = end
    above = key.rpartition(".")[0]
    return line_of(text, above) if above else None


def _has(values: Mapping[str, Any], key: str) -> bool:
    name, _, below = key.partition(".")
    if name not in values:
        return False
    return not below or (isinstance(values[name], Mapping) and _has(values[name], below))
