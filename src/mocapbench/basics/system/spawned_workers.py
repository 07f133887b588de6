"""Workers that start as new interpreters, which every system can do."""

from __future__ import annotations

import sys
from multiprocessing import resource_tracker
from multiprocessing.context import SpawnContext, SpawnProcess
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any, ClassVar

from mocapbench.basics.system.starting import (
    ONE_THREAD,
    SAFE_PATH,
    change_environment,
    hide_script,
    hold_interrupts,
)

__all__ = ["SpawnedContext", "SpawnedContextWithoutScript", "keep_files_in"]

_VARIABLES = ONE_THREAD | SAFE_PATH
"""Of the environment of workers."""


class _Process(SpawnProcess):
    """A process with an environment of its own."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        with change_environment(_VARIABLES), hold_interrupts():
            return SpawnProcess._Popen(process_obj)


class SpawnedContext(SpawnContext):
    """The context of processes that read the script which starts them."""

    Process: ClassVar[type[SpawnProcess]] = _Process


class _ProcessWithoutScript(_Process):
    """A process that does not read the script which starts it."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        with hide_script():
            return _Process._Popen(process_obj)


class SpawnedContextWithoutScript(SpawnContext):
    """The context of processes that do not read it."""

    Process: ClassVar[type[SpawnProcess]] = _ProcessWithoutScript


def keep_files_in(folder: Path) -> None:
    """Have workers that start from now on keep temporary files in a folder.

    What `multiprocessing` starts beside them, but on Windows, starts here: it runs no file of the
    current folder either.
    """
    _VARIABLES.update(dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)))
    if sys.platform != "win32":
        with change_environment(_VARIABLES):
            resource_tracker.ensure_running()
