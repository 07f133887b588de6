"""Every system: new interpreters, and a thread in each that watches what no system does for it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from functools import partial
from multiprocessing.connection import wait
from multiprocessing.context import BaseContext
from multiprocessing.process import current_process
from pathlib import Path
from typing import Any

import psutil
from filelock import FileLock, Timeout

from mocapbench.basics.system.base import LOCK
from mocapbench.basics.system.spawned_workers import (
    SpawnedContext,
    SpawnedContextWithoutScript,
    keep_files_in,
)
from mocapbench.basics.system.starting import list_signals
from mocapbench.basics.system.watch import (
    END_OF_TIME,
    END_OF_WORK,
    Watch,
    end_at_once,
    end_with,
    kill_descendants,
)

__all__ = ["Portable"]

_HAS_GROUPS = hasattr(os, "killpg")
"""Not on Windows."""


class Portable:
    """What every system has; see `System`."""

    def __init__(self) -> None:
        self._watch = Watch()

    def become_worker(self) -> None:  # noqa: D102
        for number in list_signals("SIGHUP", "SIGINT"):
            signal.signal(number, signal.SIG_IGN)  # they are for the run to deal with
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        run = multiprocessing.parent_process()
        if run is not None:
            end_with(partial(wait, [run.sentinel]))

    def make_context(  # noqa: D102
        self, preload: Sequence[str], folder: Path, *, with_script: bool
    ) -> BaseContext:
        del preload  # a new interpreter imports what it needs
        if getattr(current_process(), "_inheriting", False):
            raise RuntimeError("a process that is being started cannot start others")
        keep_files_in(folder)
        return SpawnedContext() if with_script else SpawnedContextWithoutScript()

    def call(  # noqa: D102
        self,
        prepare: Callable[[], object],
        function: Callable[..., Any],
        arguments: Sequence[Any],
        timeout: float,
    ) -> bytes:
        # Imported where it is used: it takes a while, and who resumes a finished run calls nothing.
        from mocapbench.basics.system.spawned_call import call_in_spawn  # noqa: PLC0415

        return call_in_spawn(prepare, function, arguments, timeout, self._watch.memory)

    @contextmanager
    def run_program(self, words: Sequence[str], **options: Any) -> Iterator[subprocess.Popen[Any]]:  # noqa: D102
        options |= {"process_group": 0} if _HAS_GROUPS else {}
        with subprocess.Popen(words, **options) as process:
            started = psutil.Process(process.pid)
            try:
                yield process
            finally:
                kill_descendants(started)
                process.kill()
                if _HAS_GROUPS:  # what lost its parent, and descends from nobody
                    with suppress(ProcessLookupError):
                        os.killpg(process.pid, signal.SIGKILL)

    def kill_children(self) -> None:  # noqa: D102
        kill_descendants(psutil.Process())

    def measure_memory(self, process: int) -> int:  # noqa: D102
        held = 0
        with suppress(psutil.Error):  # it has ended meanwhile
            first = psutil.Process(process)
            for each in (first, *first.children(recursive=True)):
                held += each.memory_info().rss
        return held

    def measure_peak(self) -> int:  # noqa: D102
        held = self._watch.look()
        known: int = getattr(psutil.Process().memory_info(), "peak_wset", held)  # of Windows
        return max(known, self._watch.peak)

    def limit_memory(self, most: float) -> None:  # noqa: D102
        self._watch.memory = most
        self._watch.start()

    def limit_growth(self, most: float) -> None:  # noqa: D102
        self.limit_memory(self._watch.look() + most)

    def find_memory_limit(self) -> float:  # noqa: D102
        return self._watch.memory

    def limit_work(self, seconds: float) -> None:  # noqa: D102
        self._watch.work = seconds
        self._watch.start()

    def find_work_limit(self) -> float:  # noqa: D102
        return self._watch.work

    def is_end_of_work(self, exit_code: int) -> bool:  # noqa: D102
        return exit_code == END_OF_WORK

    def end_work(self) -> None:  # noqa: D102
        end_at_once(END_OF_WORK)

    def start_timer(self, seconds: float) -> None:  # noqa: D102
        self._watch.end = time.monotonic() + seconds
        self._watch.start()

    def stop_timer(self) -> None:  # noqa: D102
        self._watch.end = float("inf")

    def is_end_of_time(self, exit_code: int) -> bool:  # noqa: D102
        return exit_code == END_OF_TIME

    @contextmanager
    def hold(self, path: Path) -> Iterator[None]:  # noqa: D102
        lock = _name_lock(path)
        with _take(lock):
            try:
                path.lstat()  # or it is gone
                yield
            finally:
                lock.unlink(missing_ok=True)

    def hold_orphan(self, path: Path) -> AbstractContextManager[None]:  # noqa: D102
        if sys.platform == "linux" and not _name_lock(path).exists():
            raise BlockingIOError(str(path))  # by that backend, which locks the path itself
        return self.hold(path)

    def is_held(self, lock: Path) -> bool:  # noqa: D102
        if not lock.exists():
            return False
        try:
            with _take(lock):
                return False
        except BlockingIOError:
            return True
        except OSError:  # a folder that cannot be written to, where nobody writes
            return False


def _name_lock(path: Path) -> Path:
    return path if path.suffix == LOCK else path.with_name(path.name + LOCK)


@contextmanager
def _take(lock: Path) -> Iterator[None]:
    """Hold a lock within the context, or raise `BlockingIOError`."""
    held = FileLock(lock, timeout=0, thread_local=False)
    try:
        held.acquire()
    except Timeout as error:
        raise BlockingIOError(str(lock)) from error
    try:
        yield
    finally:
        held.release()
