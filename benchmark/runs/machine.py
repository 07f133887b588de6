"""The share of this machine that a run may take."""

from __future__ import annotations

import psutil

__all__ = ["memory_share", "n_cores"]

MINIMUM_MEMORY = 4.0
"""GiB."""


def n_cores() -> int:
    """Return how many cores this process may use, by its affinity and its control group."""
    import joblib  # noqa: PLC0415  # it takes .1 s, as long as all else of a run that is finished

    return int(joblib.cpu_count())


def memory_share(n_workers: int) -> float:
    """Return the GiB of this machine's memory that fall to one of ``n_workers`` jobs."""
    return max(MINIMUM_MEMORY, psutil.virtual_memory().total / 2**30 / n_workers)
