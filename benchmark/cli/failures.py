"""What the command line says of an error, and the exit code for it."""

from __future__ import annotations

import traceback

from rich.console import Console
from rich.markup import escape

from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.datasets import AcclaimError, DigestMismatch

__all__ = ["explain"]


def explain(error: Exception) -> ExitCode:
    """Say on standard error what went wrong, in one line where it is the user's to mend.

    Returns
    -------
    ExitCode
        ``USAGE`` for an error of the request or of a file, ``DEFECT`` for any other: else the
        interpreter's own exit code, 1, would say that a metric got worse.
    """
    console = Console(stderr=True, emoji=False)
    match error:
        case UsageError() | DigestMismatch() | AcclaimError():
            console.print(f"[bold red]error:[/] {escape(str(error))}", soft_wrap=True)
            return ExitCode.USAGE
        case OSError():
            console.print(f"[bold red]error:[/] cannot read or write: {escape(str(error))}")
            return ExitCode.USAGE
        case _:
            traceback.print_exception(error)
            advice = "a defect of mocapbench or an added package; see above"
            console.print(f"[bold red]error:[/] {advice}")
            return ExitCode.DEFECT
