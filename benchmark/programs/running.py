"""A program that runs to its end, within the time and the memory that its process has."""

from __future__ import annotations

import math
import os
import resource
import shlex
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from multiprocessing.connection import wait
from pathlib import Path

from mocapbench.basics.processes import count_seconds_left, die_with_parent, measure_memory
from mocapbench.basics.words import printable

__all__ = ["SECONDS", "ProgramError", "run_program"]

SECONDS = "MOCAPBENCH_SECONDS"
"""The variable of the environment with the time that the program has."""
_LOOK = 0.1
"""Seconds after which the memory of a program is measured again."""
_SHARE, _RESERVE = 0.9, 5.0
"""Of the time that is left, which a program gets; and seconds beyond which no more is kept back.

In the rest this process says what became of it.
"""
_OUT_OF_WORK = (-signal.SIGXCPU, 128 + signal.SIGXCPU)
"""The exit codes of a program, and of one that a shell runs, which worked longer than it may."""
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
    told = f"{min(seconds, _find_limit(resource.RLIMIT_CPU)):.1f}"
    with _start([*words, str(files)], folder, {**variables, SECONDS: told}) as process:
        said = _watch(process, called, seconds)
    if process.returncode in _OUT_OF_WORK:
        signal.raise_signal(signal.SIGXCPU)  # its work is that of this process, and so is its limit
    if process.returncode:
        raise ProgramError(
            f"expected `{called}` to end with exit code 0, got {_name_ending(process.returncode)}"
            f"{_quote(said)}"
        )
    return _quote(said)


@contextmanager
def _start(
    words: Sequence[str], folder: Path, variables: Mapping[str, str]
) -> Iterator[subprocess.Popen[bytes]]:
    """Start a program, which is killed at the end of the context with all that it started."""
    try:
        process = subprocess.Popen(
            words,
            cwd=folder,
            env={**os.environ, **variables},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            process_group=0,
            preexec_fn=_prepare,  # noqa: PLW1509  # this process has one thread
        )
    except OSError as error:
        raise ProgramError(
            f"expected a program that can be started, got {words[0]!r}: {error.strerror}; "
            "install it, or correct the command"
        ) from error
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        assert process.stderr is not None
        process.stderr.close()


def _prepare() -> None:
    """Let the process end with this one, and reserve any addresses: Julia and CUDA do."""
    die_with_parent()
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))


def _watch(process: subprocess.Popen[bytes], called: str, seconds: float) -> bytes:
    """Return the end of what a program said, once it has ended."""
    assert process.stderr is not None
    most, speech = _find_limit(resource.RLIMIT_AS), process.stderr.fileno()
    ended, said = os.pidfd_open(process.pid), b""
    watched = [speech, ended]
    left = count_seconds_left() - seconds
    try:
        while ended not in (ready := wait(watched, _LOOK)):
            if ready:
                new = os.read(speech, 65_536)
                watched = watched if new else [ended]
                said = (said + new)[-_KEPT:]
            _require_memory(called, measure_memory(process.pid), most, said)
            if count_seconds_left() < left:
                raise TimeoutError(
                    f"expected `{called}` to end within {seconds:.3g} s, got no end{_quote(said)}"
                )
        process.wait()
        return (said + _read_rest(speech))[-_KEPT:]
    finally:
        os.close(ended)


def _find_limit(what: int) -> float:
    most, _ = resource.getrlimit(what)
    return math.inf if most == resource.RLIM_INFINITY else most


def _require_memory(called: str, held: int, most: float, said: bytes) -> None:
    if held > most:
        raise MemoryError(
            f"expected `{called}` to take at most {most / 2**30:.1f} GiB of memory, got "
            f"{held / 2**30:.1f} GiB{_quote(said)}"
        )


def _read_rest(pipe: int) -> bytes:
    """Return what is left in a pipe, which processes that live on may hold open."""
    os.set_blocking(pipe, False)
    said = b""
    with suppress(BlockingIOError):
        while new := os.read(pipe, 65_536):
            said = (said + new)[-_KEPT:]
    return said


def _name_ending(code: int) -> str:
    return f"{code}" if code > 0 else f"its end by {signal.Signals(-code).name}"


def _quote(said: bytes) -> str:
    """Return the last lines that a program wrote, as the end of a message."""
    lines = printable(said.decode(errors="replace")).split("\n")
    last = [line.strip() for line in lines if line.strip()][-_LINES:]
    return f"; it said: {' | '.join(last)}" if last else "; it said nothing on standard error"
