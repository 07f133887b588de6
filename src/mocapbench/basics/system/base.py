"""What is asked of the operating system."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from multiprocessing.context import BaseContext
from pathlib import Path
from typing import Any, Protocol

__all__ = ["LOCK", "ProcessDiedError", "System"]

LOCK = ".lock"
"""How the name of a lock ends that lies beside what it locks; Windows moves no file that is locked.
"""


class ProcessDiedError(Exception):
    """A process that ended without a result.

    Parameters
    ----------
    exit_code : int
        Its exit code; minus the signal's number if a signal ended it.
    """

    def __init__(self, exit_code: int) -> None:
        super().__init__(exit_code)
        self.exit_code = exit_code


class System(Protocol):
    """The processes, limits and locks that mocapbench needs, by the means of a system.

    A limit is that of this process. What exceeds it ends with a `MemoryError`, or by an exit code
    that the system knows again.
    """

    def become_worker(self) -> None:
        """Have this process end with the one that started it, however that ends, and at SIGTERM.

        It is found what its descendants leave behind. Ctrl-C and a closed terminal are for the
        process that started it.
        """

    def make_context(
        self, preload: Sequence[str], folder: Path, *, with_script: bool
    ) -> BaseContext:
        """Return the context of `multiprocessing` in which workers start.

        Parameters
        ----------
        preload : sequence of str
            Modules that every worker needs.
        folder : Path
            Where workers keep temporary files.
        with_script : bool
            Whether workers read the script that starts them, and find what it defines.

        Raises
        ------
        RuntimeError
            If this process is itself being started, and reads the script.
        """

    def call(
        self,
        prepare: Callable[[], object],
        function: Callable[..., Any],
        arguments: Sequence[Any],
        timeout: float,
    ) -> bytes:
        """Return the pickled result of a call; see `mocapbench.basics.child.call_in_child`."""

    def run_program(
        self, words: Sequence[str], **options: Any
    ) -> AbstractContextManager[subprocess.Popen[Any]]:
        """Start a program, which is killed at the end of the context with all that it started.

        It may reserve any addresses, and ends with this process.

        Parameters
        ----------
        words : sequence of str
            The program and its arguments.
        **options
            Of `subprocess.Popen`.

        Raises
        ------
        OSError
            If it cannot be started.
        """

    def kill_children(self) -> None:
        """Kill what this process, a worker, has started, and what that left running."""

    def measure_memory(self, process: int) -> int:
        """Return the bytes of memory that a process and all that it has started hold."""

    def measure_peak(self) -> int:
        """Return the most bytes of memory that this process, or a program of it, has held."""

    def limit_memory(self, most: float) -> None:
        """Let this process take so many bytes; by infinity, as many as its user may."""

    def limit_growth(self, most: float) -> None:
        """Let this process take so many bytes besides those that it has."""

    def find_memory_limit(self) -> float:
        """Return the bytes that this process may take; infinity if there is no limit."""

    def limit_work(self, seconds: float) -> None:
        """End this process once it has taken so much of a processor's time."""

    def find_work_limit(self) -> float:
        """Return the seconds that this process may work; infinity if there is no limit."""

    def is_end_of_work(self, exit_code: int) -> bool:
        """Return whether a process, or one that it waited for, worked longer than it may."""

    def end_work(self) -> None:
        """End this process as if it had worked longer than it may."""

    def start_timer(self, seconds: float) -> None:
        """End this process in so many seconds, whatever it does then."""

    def stop_timer(self) -> None:
        """Let the process live on."""

    def is_end_of_time(self, exit_code: int) -> bool:
        """Return whether a timer has ended a process."""

    def hold(self, path: Path) -> AbstractContextManager[None]:
        """Hold the lock of a temporary file or folder within the context.

        The lock is free however the process ends.

        Raises
        ------
        BlockingIOError
            If another holds it.
        FileNotFoundError
            If the file or folder is gone.
        """

    def hold_orphan(self, path: Path) -> AbstractContextManager[None]:
        """Hold the lock of a temporary file or folder that somebody left behind, as `hold` does.

        What may be in use by a process with another backend is not held.
        """

    def is_held(self, lock: Path) -> bool:
        """Return whether a process holds a `filelock.FileLock`, whose file need not be writable."""
