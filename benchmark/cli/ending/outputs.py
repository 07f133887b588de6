"""Standard output and error: what cannot be written there ends the command with a code of its own.

A write raises `SystemExit`, which passes every handler of errors. Otherwise typer and rich would
end the process with 1 where a pipe was closed, and that would say that a metric got worse.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO, cast

from mocapbench.benchmark.errors import OutputError

__all__ = ["whole_outputs"]


class _Output:
    """A stream whose failures are `OutputError`; the rest is as it was."""

    def __init__(self, stream: TextIO, name: str) -> None:
        self._stream, self._name = stream, name

    def write(self, text: str) -> int:
        return int(self._try(self._stream.write, text))

    def flush(self) -> None:
        self._try(self._stream.flush)

    def _try(self, function: Callable[..., Any], *arguments: str) -> Any:
        try:
            return function(*arguments)
        except OSError as error:
            raise OutputError(self._name, error) from error

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def whole_outputs() -> Iterator[None]:
    """Have whatever is written within the context reach the outputs, or end the process.

    Raises
    ------
    OutputError
        If it cannot.
    """
    _open_missing()
    streams = sys.stdout, sys.stderr
    outputs = _Output(sys.stdout, "standard output"), _Output(sys.stderr, "standard error")
    for output in outputs:
        output.reconfigure(errors="replace")  # terminals that know ASCII only
    sys.stdout, sys.stderr = cast(tuple[TextIO, TextIO], outputs)
    try:
        with _saying_why(streams[1]):
            try:
                yield
            finally:
                for output in outputs:
                    output.flush()
    finally:
        sys.stdout, sys.stderr = streams
        for stream in streams:
            _drop_what_cannot_be_written(stream)


def _open_missing() -> None:
    """Open those of standard input, output and error that were closed when the process started.

    Otherwise the next file that is opened would take the place of one, and get what is printed.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
            os.set_inheritable(number, True)
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: PTH123, SIM115


@contextmanager
def _saying_why(errors: TextIO) -> Iterator[None]:
    try:
        yield
    except OutputError as error:
        with suppress(OSError):
            errors.write(str(error))
            errors.flush()
        raise


def _drop_what_cannot_be_written(stream: TextIO) -> None:
    """Empty a stream, or else the interpreter would try again at its end, and change the code."""
    try:
        stream.flush()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
