"""A program that runs to its end, within the time and the memory that its process has."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO

from mocapbench.basics.deadline import DEADLINE, count_seconds_left, find_deadline
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.words import printable

__all__ = ["SECONDS", "ProgramError", "run_program"]

SECONDS = "MOCAPBENCH_SECONDS"
"""The variable of the environment with the time that the program has."""
_LOOK, _PATIENCE = 0.1, 5.0
"""Seconds after which the memory of a program is measured again, and for its last words."""
_SHARE, _RESERVE = 0.9, 5.0
"""Of the time that is left, which a program gets; and seconds beyond which no more is kept back.

In the rest this process says what became of it.
"""
_KEPT, _LINES = 4_000, 5
"""Bytes of what a program says that are kept, and lines that are shown."""


class ProgramError(RuntimeError):
    """A program that failed, or did not do what it should."""


def run_program(
    words: Sequence[str], files: Path, folder: Path, variables: Mapping[str, str]
) -> str:
    """Have a program do its work, and return the last lines that it wrote to standard error.

    It may hold as much memory as this process may have addresses. It reads nothing, and what it
    writes to standard output is lost. All that it started ends with it, and with this process.

    Parameters
    ----------
    words : sequence of str
        The program and its first arguments.
    files : Path
        Its last argument: the folder that it works on, which has another name every time.
    folder : Path
        Where it runs.
    variables : mapping of str to str
        Of its environment, besides those of this process.

    Raises
    ------
    ProgramError
        If it cannot be started, or ends with another exit code than 0.
    TimeoutError
        If it takes longer than it has.
    MemoryError
        If it holds more memory than it may.
    """
    called, left = f"{shlex.join(words)} FOLDER", count_seconds_left()
    seconds = max(0.0, _SHARE * left, left - _RESERVE)
    system = find_system()
    told = f"{min(seconds, system.find_work_limit()):.1f}"
    limits = {SECONDS: told, DEADLINE: find_deadline(seconds)}
    with _start([*words, str(files)], folder, {**variables, **limits}) as (process, speech):
        excess = _watch(process, called, seconds)
    said = _quote(speech.read())
    if excess is not None:
        raise type(excess)(f"{excess}{said}")
    if system.is_end_of_work(process.returncode):
        system.end_work()  # its work is that of this process, and so is its limit
    if process.returncode:
        raise ProgramError(
            f"expected `{called}` to end with exit code 0, got {_name_ending(process.returncode)}"
            f"{said}"
        )
    return said


class _Speech:
    """The end of what a program writes to standard error, read as it comes.

    Parameters
    ----------
    pipe : file
        Which other processes may hold open, too.
    """

    def __init__(self, pipe: IO[bytes]) -> None:
        self._said = b""
        self._thread = threading.Thread(
            target=self._listen, args=(os.dup(pipe.fileno()),), daemon=True
        )
        self._thread.start()

    def _listen(self, pipe: int) -> None:
        with os.fdopen(pipe, "rb", buffering=0) as speech:
            while new := speech.read(65_536):
                self._said = (self._said + new)[-_KEPT:]

    def read(self) -> bytes:
        """Return what the program, which has ended, wrote last."""
        self._thread.join(_PATIENCE)  # no longer: one that got away may hold the pipe
        return self._said


@contextmanager
def _start(
    words: Sequence[str], folder: Path, variables: Mapping[str, str]
) -> Iterator[tuple[subprocess.Popen[bytes], _Speech]]:
    """Start a program, which is killed at the end of the context with all that it started."""
    with ExitStack() as started:
        program = find_system().run_program(
            words,
            cwd=folder,
            env={**os.environ, **variables},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        try:
            process = started.enter_context(program)
        except OSError as error:
            raise ProgramError(
                f"expected a program that can be started, got {words[0]!r}: {error.strerror}; "
                "install it, or correct the command"
            ) from error
        assert process.stderr is not None
        yield process, _Speech(process.stderr)


def _watch(process: subprocess.Popen[bytes], called: str, seconds: float) -> Exception | None:
    """Wait for the end of a program, and return None; or, at once, in what it is excessive."""
    system, left = find_system(), count_seconds_left() - seconds
    most = system.find_memory_limit()
    while process.poll() is None:
        held = system.measure_memory(process.pid)
        if held > most:
            return MemoryError(
                f"expected `{called}` to take at most {most / 2**30:.1f} GiB of memory, got "
                f"{held / 2**30:.1f} GiB"
            )
        if count_seconds_left() < left:
            return TimeoutError(f"expected `{called}` to end within {seconds:.3g} s, got no end")
        with suppress(subprocess.TimeoutExpired):
            process.wait(_LOOK)
    return None


def _name_ending(code: int) -> str:
    return f"{code}" if code > 0 else f"its end by {signal.Signals(-code).name}"


def _quote(said: bytes) -> str:
    """Return the last lines that a program wrote, as the end of a message."""
    lines = printable(said.decode(errors="replace")).split("\n")
    last = [line.strip() for line in lines if line.strip()][-_LINES:]
    return f"; it said: {' | '.join(last)}" if last else "; it said nothing on standard error"
