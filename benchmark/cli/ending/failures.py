"""What the command line says of errors and warnings, and the exit code for an error."""

from __future__ import annotations

import traceback
import warnings
from typing import TextIO

from rich.text import Text

from mocapbench import datasets
from mocapbench.basics.system.choice import UnknownBackendError
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.errors import ExitCode, Interruption, OutputError, UsageError
from mocapbench.benchmark.files import words_of

__all__ = ["exit_code", "explain", "show_warning"]


ERROR = Text("error:", "bold red")


def exit_code(error: BaseException) -> ExitCode:
    """Return the exit code that an error ends with.

    Returns
    -------
    ExitCode
        ``USAGE`` for an error of the request or of a file, ``DEFECT`` for any other: else the
        interpreter's own exit code, 1, would say that a metric got worse.
    """
    return _code_and_message(error)[0]


def explain(error: Exception) -> ExitCode:
    """Say on standard error what went wrong, in one line where it is the user's to mend.

    Returns
    -------
    ExitCode
        See `exit_code`.
    """
    code, message = _code_and_message(error)
    if code is ExitCode.DEFECT:
        _quote("".join(traceback.format_exception(error)))
    _say(message)
    return code


def show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Show a warning on standard error; in place of `warnings.showwarning`.

    Ours are written for users, others are shown as Python shows them, with their place.
    """
    del file
    if category.__module__.startswith("mocapbench."):
        _say(str(message), Text("warning:", "bold"))
    else:
        _quote(warnings.formatwarning(message, category, filename, lineno, line))


def _code_and_message(error: BaseException) -> tuple[ExitCode, str]:
    """Return the exit code of an error, and what to say of it."""
    match error:
        case (
            UsageError()
            | UnknownBackendError()
            | datasets.DigestMismatch()
            | datasets.AcclaimError()
            | datasets.FormatError()
        ):
            return ExitCode.USAGE, str(error)
        case OSError():
            return ExitCode.USAGE, f"cannot read or write: {words_of(error)}"
        case Interruption() | OutputError():
            return error.exit_code, str(error)
        case KeyboardInterrupt():
            return ExitCode.INTERRUPTED, "interrupted"
        case _:
            return ExitCode.DEFECT, "a defect of mocapbench or an added package; see above"


def _say(message: str, kind: Text = ERROR) -> None:
    LiteralConsole(stderr=True).print(kind, message, soft_wrap=True)


def _quote(text: str) -> None:
    LiteralConsole(stderr=True).print(text, end="", soft_wrap=True, highlight=False)
