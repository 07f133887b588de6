"""The process from which workers are forked: it loads the libraries once, and computes nothing."""

from __future__ import annotations

import multiprocessing
from multiprocessing import forkserver
from multiprocessing.context import BaseContext

__all__ = ["fork_server", "load_libraries_ahead"]

_PRELOAD = [
    "mocapbench.benchmark.runs.execution.worker",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]


def fork_server() -> BaseContext:
    """Return the context of processes forked from the server."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOAD)
    return context


def load_libraries_ahead() -> None:
    """Start the server, which takes a second or two, while this process goes on."""
    fork_server()
    forkserver.ensure_running()
