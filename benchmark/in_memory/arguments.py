"""Messages of the command for those who write Python: options are arguments."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from mocapbench.benchmark.errors import UnregisteredNameError, UsageError
from mocapbench.datasets import FormatError

__all__ = ["name_arguments", "translate_errors"]

_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*)")


def name_arguments(text: str) -> str:
    """Return a message that names arguments where it named options of the command.

    Examples
    --------
    >>> from mocapbench.benchmark.in_memory.arguments import name_arguments
    >>> name_arguments("raise --max-gap")
    'raise max_gap='
    """
    return _OPTION.sub(lambda found: f"{found[1].replace('-', '_')}=", text)


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
