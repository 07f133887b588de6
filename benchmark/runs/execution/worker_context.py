"""How workers start: with what jobs need loaded as far as the system can, and nothing computed."""

from __future__ import annotations

from multiprocessing.context import BaseContext

from mocapbench.basics.scratch import process_folder
from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.errors import UsageError

__all__ = ["UNGUARDED", "worker_context", "worker_context_without_script"]

UNGUARDED = (
    "expected workers to start, got a script that starts the run again in each of them; put what "
    'it does below `if __name__ == "__main__":`'
)
_PRELOAD = [
    "mocapbench.benchmark.runs.execution.worker",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]


def worker_context() -> BaseContext:
    """Return the context in which workers start, once the system begins to load their libraries.

    Linux forks workers from a server, which takes a second or two to load the libraries, while this
    process goes on.

    Raises
    ------
    UsageError
        If a worker reads a script that starts a run wherever it is read.
    """
    try:
        return find_system().make_context(_PRELOAD, process_folder(), with_script=True)
    except RuntimeError:  # this process is starting itself, and reads the user's script again
        raise UsageError(UNGUARDED) from None


def worker_context_without_script() -> BaseContext:
    """Return the context of workers that do not read the user's script, as `worker_context`.

    They find nothing that the script defines. It may be a notebook or come from standard input, and
    need not guard what it does by ``if __name__ == "__main__":``.
    """
    return find_system().make_context(_PRELOAD, process_folder(), with_script=False)
