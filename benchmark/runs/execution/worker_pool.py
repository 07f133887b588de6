"""Processes forked from a server that has the libraries loaded and has computed nothing."""

from __future__ import annotations

import multiprocessing

from pebble import ProcessPool

from mocapbench.benchmark.runs.execution.worker import prepare_worker

__all__ = ["worker_pool"]

_PRELOAD = [
    "mocapbench.benchmark.runs.execution.worker",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]


def worker_pool(n_workers: int) -> ProcessPool:
    """Return a pool of that many workers, started when the first job comes.

    One that dies is replaced.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOAD)
    return ProcessPool(n_workers, context=context, initializer=prepare_worker)
