"""Workers, forked from a process that loads the libraries once, and computes nothing."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Sequence
from multiprocessing import forkserver, resource_tracker
from multiprocessing.context import ForkServerContext, ForkServerProcess
from multiprocessing.process import BaseProcess, current_process
from pathlib import Path
from typing import Any, ClassVar

from mocapbench.basics.system.starting import (
    ONE_THREAD,
    SAFE_PATH,
    change_environment,
    hide_script,
    hold_interrupts,
)

__all__ = ["ForkedContext", "ForkedContextWithoutScript", "ask_server"]

_LONGEST_FOLDER = 107 - len("/listener-12345678")
"""In bytes, of one for sockets, whose paths may have 107."""
_VARIABLES = ONE_THREAD | SAFE_PATH
"""Of the server's environment, as it was last asked for: it may have to be started again."""


class _Process(ForkServerProcess):
    """A process forked from our server, which is started again if it has died."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        _ensure_running()
        return ForkServerProcess._Popen(process_obj)


class ForkedContext(ForkServerContext):
    """The context of processes that read the script which starts them."""

    Process: ClassVar[type[ForkServerProcess]] = _Process


class _ProcessWithoutScript(_Process):
    """A process that does not read the script which starts it."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        with hide_script():
            return _Process._Popen(process_obj)


class ForkedContextWithoutScript(ForkServerContext):
    """The context of processes that do not read it."""

    Process: ClassVar[type[ForkServerProcess]] = _ProcessWithoutScript


def ask_server(preload: Sequence[str], folder: Path) -> None:
    """Start the server unless it runs, and have it load modules, while this process goes on.

    Parameters
    ----------
    preload : sequence of str
        The modules.
    folder : Path
        Where it, and what it forks, keep temporary files: those that `multiprocessing` has
        elsewhere stay if this process is killed.
    """
    multiprocessing.set_forkserver_preload([*preload])
    if len(os.fsencode(folder)) <= _LONGEST_FOLDER:
        current_process()._config.setdefault("tempdir", str(folder))  # type: ignore[attr-defined]
    _VARIABLES["TMPDIR"] = str(folder)
    _ensure_running()


def _ensure_running() -> None:
    with change_environment(_VARIABLES):
        resource_tracker.ensure_running()  # here, for it lets interrupts in
        with hold_interrupts():
            forkserver.ensure_running()
