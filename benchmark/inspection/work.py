"""How long fits are expected to take, by those of a run directory and of a run of ours."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Iterable, Mapping
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

from mocapbench.basics.words import format_count
from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.progress import in_words
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.address import Address

__all__ = ["MEASURED", "Basis", "ExpectedWork", "alike", "of_records", "typical", "work_of"]

MEASURED = {"smoke": "smoke", "quick": "quick", "paper": "quick"}
"""Of each profile, the one whose fits were measured; those of ``paper`` take longer."""

_TYPICAL = Path(__file__).with_name("typical_seconds.csv")


def alike(address: Address) -> tuple[tuple[str, ...], ...]:
    """Return among what jobs to look for alike ones, the most alike first."""
    return (address.task, address.label), (address.label,), ()


def of_records(records: Iterable[Record]) -> Durations:
    """Return how long the fits of ``records`` took, predictions included."""
    return _learnt(
        (record.address, record.fit_seconds + (record.predict_seconds or 0.0))
        for record in records
        if record.fit_seconds is not None
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


class ExpectedWork(NamedTuple):
    """Fits to do; to predict by a fit that is shared, and to score, takes little time beside it.

    Parameters
    ----------
    seconds : tuple of float
        How long each is expected to take.
    known_by : mapping of Basis to int
        Of how many that is known by what.
    """

    seconds: tuple[float, ...]
    known_by: Mapping[Basis, int]

    @property
    def total(self) -> float:
        """Seconds of all fits one after the other."""
        return sum(self.seconds)

    def wall_time(self, n_workers: int) -> float:
        """Return the seconds that it takes with so many jobs at once."""
        return max(self.total / n_workers, *self.seconds, 0.0)

    def in_words(self, n_workers: int | None) -> str:
        """Return how long it takes with so many jobs at once; None if a cluster decides."""
        fits = f"{in_words(self.total)} of work in {format_count(len(self.seconds), 'fit')}"
        if n_workers is None:
            return f"about {fits}, divided among the workers of the cluster"
        wall = in_words(self.wall_time(n_workers))
        return f"about {wall} with {format_count(n_workers, 'job')} at once ({fits})"


def work_of(fits: Iterable[Address], records: Iterable[Record], profile: str) -> ExpectedWork:
    """Return the work of some fits.

    Parameters
    ----------
    fits : iterable of Address
    records : iterable of Record
        Of the run directory; they tell how long fits take.
    profile : str
        Tells how long a fit takes of which there is no record.
    """
    own, developers = of_records(records), typical(profile)
    estimates = [_estimate(address, own, developers) for address in fits]
    seconds = tuple(seconds for _, seconds in estimates)
    return ExpectedWork(seconds, Counter(basis for basis, _ in estimates))


def _estimate(address: Address, own: Durations, developers: Durations) -> tuple[Basis, float]:
    """Return how long a fit takes by the surest of the ways that know; the last always does."""
    *entrant, anything = alike(address)
    if own.knows(entrant):
        return Basis.RECORDS, own.expect_seconds(entrant)
    if developers.knows(entrant):
        return Basis.TYPICAL, developers.expect_seconds(entrant)
    return Basis.MEAN, developers.expect_seconds([anything])
