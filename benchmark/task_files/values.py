"""Kinds of values that several keys of a task file have."""

from __future__ import annotations

import re
from typing import Annotated, Any

from msgspec import Meta

from mocapbench.benchmark.files import is_path_below
from mocapbench.benchmark.foreign_files import ForeignFileError, Name, fit_schema
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.selection import Span, parse_span

__all__ = [
    "is_count",
    "is_path",
    "is_positive",
    "is_text",
    "read_channels",
    "read_names",
    "read_patterns",
    "read_spans",
]

_SPANS = 'a text such as "120:180", with frames counted from 0 and the last one left out'


def is_text(value: Any) -> bool:
    """Return whether a value is a text that says something."""
    return _fits(value, Name) and bool(value.strip())


def is_path(value: Any) -> bool:
    """Return whether a value is a path or pattern that stays below a folder, without a colon."""
    return is_text(value) and ":" not in value and is_path_below(value)


def is_count(value: Any) -> bool:
    """Return whether a value is a whole number from 1 to 10,000."""
    return _fits(value, Annotated[int, Meta(ge=1, le=10_000)])


def is_positive(value: Any) -> bool:
    """Return whether a value is a number above 0, of frames per second or of seconds."""
    return _fits(value, Annotated[float, Meta(gt=0.0, le=1e9)])


def _fits(value: Any, schema: Any) -> bool:
    try:
        fit_schema(value, schema)
    except ForeignFileError:
        return False
    return True


def read_names(document: Document, key: str, example: str) -> tuple[str, ...]:
    """Return a list of different texts, none where the file has no such key."""
    names: list[str] = document.read(key, [], _are_names, "a list of different texts", example)
    return tuple(names)


def read_patterns(document: Document, key: str, default: list[str]) -> tuple[str, ...]:
    """Return patterns of files below the folder of recordings; a text stands for a list of one."""
    patterns = document.read(
        key,
        default,
        lambda value: _are_patterns(_list_values(value)),
        "names or patterns of files in the folder of recordings, without .. and : and a leading /",
        '["*.csv"]',
    )
    return tuple(_list_values(patterns))


def read_channels(document: Document, key: str) -> tuple[str, ...]:
    """Return regular expressions of names of channels, none where the file has no such key."""
    patterns: list[str] = document.read(
        key,
        [],
        lambda value: _are_expressions(_list_values(value)),
        "regular expressions of whole names of channels",
        '["lknee.*", "rknee.*"]',
    )
    return tuple(_list_values(patterns))


def read_spans(document: Document, key: str, default: list[str]) -> tuple[Span, ...]:
    """Return spans of frames; a text stands for a list of one."""
    texts = document.read(
        key, default, lambda value: _are_spans(_list_values(value)), _SPANS, '"120:180"'
    )
    return tuple(map(parse_span, _list_values(texts)))


def _list_values(value: Any) -> Any:
    return [value] if isinstance(value, str) else value


def _are_names(value: Any) -> bool:
    return _are_texts(value) and len(set(value)) == len(value)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(map(is_text, value))


def _are_patterns(value: Any) -> bool:
    return _are_texts(value) and all(map(is_path, value))


def _are_expressions(value: Any) -> bool:
    try:
        return _are_texts(value) and all(map(re.compile, value))
    except (re.error, OverflowError, RecursionError):
        return False


def _are_spans(value: Any) -> bool:
    try:
        return _are_texts(value) and all(map(parse_span, value))
    except ValueError:
        return False
