"""Which workers may run jobs: those on which a job has the result that it has here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from distributed import Client

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.installation import difference, installation

__all__ = ["require_workers"]

_PATIENCE = 60.0
"""Seconds in which the first worker must come."""


def require_workers(client: Client) -> None:
    """Wait for the first worker, and refuse a cluster with another installation.

    Raises
    ------
    UsageError
        If there is no worker, or one on which results could differ; and if the scheduler, which
        reads what it passes on, cannot.
    """
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError as error:
        raise UsageError(
            f"expected the scheduler to have a worker, got none within {_PATIENCE:.0f} s; start "
            "workers, and give the same command again"
        ) from error
    for place, found in _installations(client):
        match found:
            case OSError():  # it is gone; should it come again, the run's plug-in looks at it
                continue
            case Exception():
                reason = f"expected mocapbench as it is here, got {found}"
            case _:
                reason = difference(installation(), found)
        if reason:
            raise UsageError(f"{place}: {reason}; install the same there as here")


def _installations(client: Client) -> Iterator[tuple[str, Mapping[str, str] | Exception]]:
    """Yield what is installed on the scheduler and on each worker, or why that cannot be told."""
    try:
        yield "the scheduler", client.run_on_scheduler(installation)
    except Exception as error:  # whatever an import raises there
        yield "the scheduler", error
    for address, found in client.run(installation, on_error="return").items():
        yield f"worker {address}", found
