"""A cluster that is there already, found by the address of its scheduler."""

from __future__ import annotations

from contextlib import ExitStack

from distributed import Client

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.admission import require_workers
from mocapbench.benchmark.runs.cluster.backend import ClusterBackend

__all__ = ["open_backend"]

_PATIENCE = 20.0
"""Seconds in which the scheduler must answer."""


def open_backend(address: str) -> ClusterBackend:
    """Return the cluster whose scheduler has this address.

    Parameters
    ----------
    address : str
        Such as ``tcp://10.0.0.1:8786``.

    Raises
    ------
    UsageError
        If no scheduler answers there, or its workers are not fit for the run.
    """
    with ExitStack() as held:
        try:
            client = held.enter_context(Client(address, timeout=_PATIENCE))
        except (OSError, ValueError, ImportError) as error:
            raise UsageError(
                "--scheduler: expected the address of a dask scheduler that answers, such as "
                f"tcp://10.0.0.1:8786, got {address!r}: {error}; `dask scheduler` starts one and "
                "prints its address"
            ) from error
        require_workers(client)
        return ClusterBackend(client, held.pop_all())
