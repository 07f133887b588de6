"""Descriptions of functions and values, by which keys tell two of them apart.

A function is described by its name, by the source that it stands on, and by the values that are
bound to it or that it closes over; a value by its content and, if its class is not a builtin one,
by the source of that class. What has no such description is refused, because a key that overlooks
a difference would take one result for another.
"""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import partial, singledispatch
from pathlib import PurePath
from types import BuiltinFunctionType, FunctionType, MethodType
from typing import Any

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.source_code.digest import source_digest

__all__ = ["describe_value"]

Packages = tuple[str, ...]


@singledispatch
def describe_value(value: object, within: Packages) -> Any:
    """Return what JSON can hold of a function or value, the same in every process.

    Parameters
    ----------
    value : object
        A function, also with arguments bound to it; a number, text, enum member, path, array, or a
        tuple, list, set, mapping, dataclass or other object of such values.
    within : tuple of str
        Packages of ours whose source counts; see `source_digest`.

    Raises
    ------
    UsageError
        If the value is of a kind that cannot be told from others of its kind.
    """
    try:
        # The content comes first, since a class may have much source.
        content = describe_value(_content(value), within)
    except (TypeError, RecursionError) as error:  # it has no content that Python can see
        raise UsageError(
            "expected arguments of a problem or a metric that can be told apart (numbers, texts, "
            f"tuples, mappings, arrays, dataclasses of these), got {value!r:.200}; use a dataclass"
        ) from error
    return [describe_value(type(value), within), content]


def _content(value: Any) -> dict[str, Any]:
    if is_dataclass(value):
        return {field.name: getattr(value, field.name) for field in fields(value)}
    return dict(vars(value))


@describe_value.register(type(None))
@describe_value.register(int | float | complex | str | bytes | np.generic)
def _plain(value: object, within: Packages) -> Any:
    del within  # its text has all of it
    return repr(value)


@describe_value.register(Enum | PurePath)
def _describe_by_text(value: Enum | PurePath, within: Packages) -> Any:
    del within  # its text has all of it
    return [type(value).__qualname__, str(value)]


@describe_value.register
def _array(value: np.ndarray, within: Packages) -> Any:
    if value.dtype.hasobject:
        return ["objects", list(value.shape), describe_value(value.ravel().tolist(), within)]
    content = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
    return ["array", value.dtype.str, list(value.shape), content]


@describe_value.register(tuple | list)
def _sequence(value: tuple[Any, ...] | list[Any], within: Packages) -> Any:
    return [type(value).__qualname__, *(describe_value(item, within) for item in value)]


@describe_value.register(set | frozenset)
def _set(value: set[Any] | frozenset[Any], within: Packages) -> Any:
    return ["set", *sorted(json.dumps(describe_value(item, within)) for item in value)]


@describe_value.register
def _mapping(value: Mapping, within: Packages) -> Any:  # type: ignore[type-arg]  # as registered
    pairs = (
        [describe_value(key, within), describe_value(item, within)] for key, item in value.items()
    )
    return ["mapping", *pairs]


@describe_value.register
def _partial(value: partial, within: Packages) -> Any:  # type: ignore[type-arg]  # as registered
    bound = (value.func, value.args, dict(sorted(value.keywords.items())))
    return ["partial", *(describe_value(part, within) for part in bound)]


@describe_value.register
def _function(value: FunctionType, within: Packages) -> Any:
    enclosed = dict(inspect.getclosurevars(value).nonlocals)
    source = source_digest(value.__module__, within)
    return [value.__qualname__, source, describe_value(enclosed, within)]


@describe_value.register
def _method(value: MethodType, within: Packages) -> Any:
    return [
        "method",
        describe_value(value.__func__, within),
        describe_value(value.__self__, within),
    ]


@describe_value.register(BuiltinFunctionType | np.ufunc)
def _builtin(value: BuiltinFunctionType | np.ufunc, within: Packages) -> Any:
    del within  # versions of the libraries are part of every key
    return ["builtin", value.__name__]


@describe_value.register
def _class(value: type, within: Packages) -> Any:
    return [value.__qualname__, source_digest(value.__module__, within)]
