"""Messages of the command for those who write Python: options are arguments."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf
from numbers import Integral, Real
from typing import Any

from mocapbench.benchmark.errors import UnregisteredNameError, UsageError
from mocapbench.datasets import FormatError

__all__ = [
    "list_given",
    "name_arguments",
    "require_count",
    "require_positive",
    "translate_errors",
]

_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*)")
_FRAMES = re.compile(r"frames=, such as ([0-9]+):([0-9]+)")


def name_arguments(text: str) -> str:
    """Return a message that names arguments where it named options of the command.

    Examples
    --------
    >>> from mocapbench.benchmark.in_memory.arguments import name_arguments
    >>> name_arguments("raise --max-gap")
    'raise max_gap='
    """
    named = _OPTION.sub(lambda found: f"{found[1].replace('-', '_')}=", text)
    return _FRAMES.sub(r"frames=, such as (\1, \2)", named)


def require_positive(name: str, value: object, unit: str = "") -> float:
    """Return an argument; refuse what is no finite number above 0.

    Messages name the ``unit``, such as ``"in seconds, "``.
    """
    if not isinstance(value, bool) and isinstance(value, Real) and 0 < float(value) < inf:
        return float(value)
    raise ValueError(f"expected {name}= {unit}above 0, got {value!r}")


def require_count(name: str, value: object) -> None:
    """Refuse an argument that is no whole number of 1 or more."""
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < 1:
        raise ValueError(f"expected {name}= of 1 or more, got {value!r}")


def list_given(given: Any) -> list[Any]:
    """Return what an argument holds: a list or tuple of recordings, or a single one."""
    return [*given] if isinstance(given, list | tuple) else [given]


@contextmanager
def translate_errors() -> Iterator[None]:
    """Have errors of the user's name arguments where they name options of the command."""
    try:
        yield
    except UnregisteredNameError as error:
        raise UsageError(f"{error.args[0]} A model of your own is handed over itself") from None
    except (UsageError, FormatError) as error:
        text = name_arguments(str(error))
        if text == str(error):
            raise
        raise UsageError(text) from error.__cause__
