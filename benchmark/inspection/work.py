"""How long fits are expected to take, by those of a run directory and of a run of ours."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from enum import StrEnum
from typing import NamedTuple

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.fit_seconds import alike, of_records, typical
from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.progress import in_words
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Basis", "ExpectedWork", "work_of"]


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
