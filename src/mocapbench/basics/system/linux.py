"""Linux: forks, limits of the system, and processes that it ends with their parent."""

from __future__ import annotations

import ctypes
import fcntl
import math
import os
import resource
import signal
import stat
import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from functools import partial
from multiprocessing.context import BaseContext
from pathlib import Path
from typing import Any

import psutil

from mocapbench.basics.system.base import LOCK
from mocapbench.basics.system.forked_call import call_in_fork
from mocapbench.basics.system.forked_workers import (
    ForkedContext,
    ForkedContextWithoutScript,
    ask_server,
)
from mocapbench.basics.system.large_pages import collapse_memory

__all__ = ["Linux"]

_LIBC = ctypes.CDLL(None)  # loaded before a fork: in the child it would cost pages of memory
_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)
_LOCK = ".gitignore"
"""The file of a folder that is locked; as it says ``*``, git takes nothing that was left there."""


class Linux:
    """What Linux has; see `System`."""

    def become_worker(self) -> None:  # noqa: D102
        signal.signal(signal.SIGHUP, signal.SIG_IGN)  # a closed terminal is for the run
        die_with_parent()
        _LIBC.prctl(_PR_SET_CHILD_SUBREAPER, 1)
        # At once when told to, with the child: a worker that winds up holds up the end of a run.
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        collapse_memory()

    def make_context(  # noqa: D102
        self, preload: Sequence[str], folder: Path, *, with_script: bool
    ) -> BaseContext:
        ask_server(preload, folder)
        return ForkedContext() if with_script else ForkedContextWithoutScript()

    def call(  # noqa: D102
        self,
        prepare: Callable[[], object],
        function: Callable[..., Any],
        arguments: Sequence[Any],
        timeout: float,
    ) -> bytes:
        del prepare  # a fork knows all that this process does
        return call_in_fork(partial(function, *arguments), die_with_parent, timeout)

    @contextmanager
    def run_program(self, words: Sequence[str], **options: Any) -> Iterator[subprocess.Popen[Any]]:  # noqa: D102
        with subprocess.Popen(
            words,
            process_group=0,
            preexec_fn=_begin_program,  # noqa: PLW1509  # this process has one thread
            **options,
        ) as process:
            try:
                yield process
            finally:
                with suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)

    def kill_children(self) -> None:  # noqa: D102
        while children := [*_list_children()]:
            for child in children:
                os.kill(child, signal.SIGKILL)
                os.waitpid(child, 0)

    def measure_memory(self, process: int) -> int:  # noqa: D102
        held = 0
        with suppress(psutil.Error, OSError):  # it has ended meanwhile
            held += psutil.Process(process).memory_info().rss
            held += sum(map(self.measure_memory, _list_children(process)))
        return held

    def measure_peak(self) -> int:  # noqa: D102
        both = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN
        return max(resource.getrusage(each).ru_maxrss for each in both) * 1024

    def limit_memory(self, most: float) -> None:  # noqa: D102
        _limit(resource.RLIMIT_AS, most)

    def limit_growth(self, most: float) -> None:  # noqa: D102
        _limit(resource.RLIMIT_AS, psutil.Process().memory_info().vms + most)

    def find_memory_limit(self) -> float:  # noqa: D102
        return _find_limit(resource.RLIMIT_AS)

    def limit_work(self, seconds: float) -> None:  # noqa: D102
        _limit(resource.RLIMIT_CPU, seconds)

    def find_work_limit(self) -> float:  # noqa: D102
        return _find_limit(resource.RLIMIT_CPU)

    def is_end_of_work(self, exit_code: int) -> bool:  # noqa: D102
        return exit_code in {-signal.SIGXCPU, 128 + signal.SIGXCPU}  # the latter is a shell's

    def end_work(self) -> None:  # noqa: D102
        signal.raise_signal(signal.SIGXCPU)

    def start_timer(self, seconds: float) -> None:  # noqa: D102
        # A signal that is not handled ends a loop in a library's C code, too.
        signal.setitimer(signal.ITIMER_REAL, seconds)

    def stop_timer(self) -> None:  # noqa: D102
        signal.setitimer(signal.ITIMER_REAL, 0.0)

    def is_end_of_time(self, exit_code: int) -> bool:  # noqa: D102
        return exit_code == -signal.SIGALRM

    @contextmanager
    def hold(self, path: Path) -> Iterator[None]:  # noqa: D102
        of_folder = stat.S_ISDIR(path.lstat().st_mode)
        lock, create = (path / _LOCK, os.O_CREAT) if of_folder else (path, 0)
        descriptor = os.open(lock, os.O_RDWR | create | os.O_NOFOLLOW | os.O_NONBLOCK, 0o600)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if not os.path.samestat(os.fstat(descriptor), lock.stat()):
                raise FileNotFoundError(path)
            yield
        finally:
            os.close(descriptor)

    def hold_orphan(self, path: Path) -> AbstractContextManager[None]:  # noqa: D102
        if path.with_name(path.name + LOCK).exists():
            raise BlockingIOError(str(path))
        return self.hold(path)

    def is_held(self, lock: Path) -> bool:  # noqa: D102
        try:
            with lock.open("rb") as file:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except FileNotFoundError:
            return False
        except BlockingIOError:
            return True
        return False


def die_with_parent() -> None:
    """Have the system kill this process when the one that started it ends, however that ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _begin_program() -> None:
    """Let the process end with this one, and reserve any addresses: Julia and CUDA do."""
    die_with_parent()
    _limit(resource.RLIMIT_AS, math.inf)


def _list_children(process: int | str = "self") -> Iterator[int]:
    """Yield the numbers of the processes that a process has started."""
    for thread in Path(f"/proc/{process}/task").iterdir():
        with suppress(FileNotFoundError):  # a kernel that does not list children
            yield from map(int, (thread / "children").read_text().split())


def _limit(what: int, most: float) -> None:
    """Limit this process to so much of a resource, or to what the user's shell allows if less."""
    _, hard = resource.getrlimit(what)
    allowed = math.inf if hard == resource.RLIM_INFINITY else hard
    soft = hard if most >= allowed else math.ceil(most)
    resource.setrlimit(what, (soft, hard))


def _find_limit(what: int) -> float:
    most, _ = resource.getrlimit(what)
    return math.inf if most == resource.RLIM_INFINITY else most
