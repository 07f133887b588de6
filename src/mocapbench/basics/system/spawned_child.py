"""The process in which a call is made that another process has written down."""

from __future__ import annotations

import os
import pickle
import sys
import traceback
from multiprocessing import spawn
from pathlib import Path
from typing import Any

import psutil

from mocapbench.basics.deadline import set_deadline
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.system.watch import end_with, kill_descendants

__all__ = ["CALL", "RESULT", "STARTED", "report_result"]

CALL, STARTED, RESULT = "call", "started", "result"
"""The files of a call: what is called, that its process is ready, and what the call returns."""


def report_result(folder: Path) -> None:
    """Make the call of a folder, write down its result, and end this process."""
    exit_code = 1
    try:
        _end_with_caller()
        result = pickle.dumps(_make_call(folder), protocol=pickle.HIGHEST_PROTOCOL)
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        (folder / RESULT).write_bytes(result)
        exit_code = 0
    except BaseException:
        traceback.print_exc()
    finally:  # at once: nothing is worth tidying up, but what is left running
        kill_descendants(psutil.Process())
        os._exit(exit_code)


def _end_with_caller() -> None:
    """End this process when the pipe of standard input ends; what reads from it finds nothing."""
    caller = os.fdopen(os.dup(0), "rb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    end_with(caller.read)


def _make_call(folder: Path) -> Any:
    """Return the result of a call: what it needs is read first, and registered next."""
    surroundings, prepare, call = pickle.loads((folder / CALL).read_bytes())
    spawn.prepare(pickle.loads(surroundings))  # the path, the folder, and the script
    pickle.loads(prepare)()
    function, arguments, timeout, memory = pickle.loads(call)
    find_system().limit_memory(memory)
    set_deadline(timeout)
    (folder / STARTED).touch()
    return function(*arguments)


if __name__ == "__main__":
    report_result(Path(sys.argv[1]))
