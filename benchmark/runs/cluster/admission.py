"""Which workers may run jobs: those on which a job has the result that it has here."""

from __future__ import annotations

from distributed import Client

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.installation import difference, installation

__all__ = ["require_workers"]

_PATIENCE = 60.0
"""Seconds in which the first worker must come."""


def require_workers(client: Client) -> None:
    """Wait for the first worker, and refuse those with another installation.

    Raises
    ------
    UsageError
        If there is no worker, or one on which results could differ.
    """
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise UsageError(
            f"expected the scheduler to have a worker, got none within {_PATIENCE:.0f} s; start "
            "workers, and give the same command again"
        ) from error
    for address, found in client.run(installation, on_error="return").items():
        match found:
            case Exception():
                reason = f"expected mocapbench as it is here, got {found}"
            case _:
                reason = difference(installation(), found)
        if reason:
            raise UsageError(f"worker {address}: {reason}; install the same there as here")
