"""How long fits are expected to take, by those of a run directory and of a run of ours."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from enum import StrEnum
from pathlib import Path

from mocapbench.basics.words import format_count
from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.progress import in_words
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.address import Address

__all__ = [
    "MEASURED",
    "Basis",
    "Estimate",
    "alike",
    "describe_work",
    "estimate_fits",
    "of_records",
    "typical",
    "wall_time",
]

MEASURED = {"smoke": "smoke", "quick": "quick", "paper": "quick"}
"""Of each profile, the one whose fits were measured; those of ``paper`` take longer."""

_TYPICAL = Path(__file__).with_name("typical_seconds.csv")
"""What docs/evidence/typical_seconds.py prints."""


def alike(address: Address) -> tuple[tuple[str, ...], ...]:
    """Return among what jobs to look for alike ones, the most alike first."""
    task, _, case, _, label = address
    return (task, label, case), (task, label), (label,), ()


def of_records(records: Iterable[Record]) -> Durations:
    """Return how long the fits of ``records`` took, predictions included."""
    return _learnt(
        (record.address, record.seconds) for record in records if record.seconds is not None
    )


def _learnt(seconds: Iterable[tuple[Address, float]]) -> Durations:
    durations = Durations()
    for address, each in seconds:
        durations.learn(alike(address), each)
    return durations


def typical(profile: str) -> Durations:
    """Return how long a fit of each entrant took in a run of ours, on one core of a server.

    Parameters
    ----------
    profile : str
        See `MEASURED`.
    """
    with _TYPICAL.open(encoding="utf-8", newline="") as file:
        return _learnt(
            (Address(row["task"], 0, "", 0, row["label"]), float(row["seconds"]))
            for row in csv.DictReader(file)
            if row["profile"] == MEASURED[profile]
        )


class Basis(StrEnum):
    """How the time of a fit is known, the surest first."""

    RECORDS = "the entrant's records in the run directory"
    TYPICAL = "the entrant's mean in a run of the developers"
    MEAN = "the mean of all entrants there"


Estimate = tuple[float, Basis]
"""How many seconds a fit is expected to take, and how that is known."""


def wall_time(seconds: Sequence[float], n_workers: int) -> float:
    """Return how long fits take that take so many seconds each, with so many jobs at once."""
    return max(sum(seconds) / n_workers, *seconds, 0.0)


def describe_work(fits: Sequence[Estimate], n_workers: int | None) -> str:
    """Return how long fits take with so many jobs at once; None if a cluster decides.

    To predict by a fit that is shared, and to score, takes little time beside it.
    """
    seconds = [each for each, _ in fits]
    work = f"{in_words(sum(seconds))} of work in {format_count(len(fits), 'fit')}"
    if n_workers is None:
        return f"about {work}, divided among the workers of the cluster"
    wall = in_words(wall_time(seconds, n_workers))
    return f"about {wall} with {format_count(n_workers, 'job')} at once ({work})"


def estimate_fits(
    fits: Iterable[Address], records: Iterable[Record], profile: str
) -> list[Estimate]:
    """Return how long each of some fits is expected to take.

    Parameters
    ----------
    fits : iterable of Address
    records : iterable of Record
        Of the run directory; they tell how long fits take.
    profile : str
        Tells how long a fit takes of which there is no record.
    """
    own, developers = of_records(records), typical(profile)
    return [_estimate(address, own, developers) for address in fits]


def _estimate(address: Address, own: Durations, developers: Durations) -> Estimate:
    """Return how long a fit takes by the surest of the ways that know; the last always does."""
    *entrant, anything = alike(address)
    if own.knows(entrant):
        return own.expect_seconds(entrant), Basis.RECORDS
    if developers.knows(entrant):
        return developers.expect_seconds(entrant), Basis.TYPICAL
    return developers.expect_seconds([anything]), Basis.MEAN
