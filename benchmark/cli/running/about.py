"""What is to be known of a run, which its plan and every record keep."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from mocapbench import benchmark as bench
from mocapbench import datasets

if TYPE_CHECKING:
    from mocapbench.benchmark import Job, Request

__all__ = ["about"]


def about(planned: Sequence[Job], request: Request, threads: int) -> dict[str, str]:
    """Return what is to be known of the run: its provenance, its request and when it started."""
    return {
        **bench.provenance(["mocapbench", *sys.argv[1:]], threads),
        "profile": request.profile,
        "seed": str(request.seed),
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        **_acknowledgement(planned),
    }


def _acknowledgement(planned: Sequence[Job]) -> dict[str, str]:
    """Return what the database asks to be said of work that uses it."""
    used = any(uri.startswith("cmu:") for job in planned if not job.missing for uri in job.digests)
    return {"acknowledgement": datasets.CMU_ACKNOWLEDGEMENT} if used else {}
