"""What a planned run will do: how many jobs of which kind, and for how long."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple

from mocapbench.benchmark.inspection.explanation import Explanation, Step
from mocapbench.benchmark.inspection.fit_seconds import alike, of_records, typical
from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Basis", "Forecast", "Work", "forecast"]


class Basis(StrEnum):
    """How the time of a fit is known, the surest first."""

    RECORDS = "the entrant's records in the run directory"
    TYPICAL = "the entrant's mean in a run of the developers"
    MEAN = "the mean of all entrants there"


class Work(NamedTuple):
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


@dataclass(frozen=True)
class Forecast:
    """What a planned run will do.

    Parameters
    ----------
    profile : str
    steps : mapping of Step to int
        How many jobs are skipped, fitted, only scored, or cannot run.
    now : Work
        With the recordings that are here.
    with_all : Work
        With all recordings that the jobs need.
    """

    profile: str
    steps: Mapping[Step, int]
    now: Work
    with_all: Work


def forecast(
    jobs: Sequence[Job], explanations: Sequence[Explanation], out: Path, profile: str
) -> Forecast:
    """Return what a run will do.

    Parameters
    ----------
    jobs : sequence of Job
    explanations : sequence of Explanation
        What becomes of each of the jobs.
    out : Path
        The run directory, which need not be there. Its records tell how long fits take.
    profile : str
        Of the run; tells how long a fit takes of which there is no record.
    """
    ways, steps = _ways(out, profile), Counter(item.step for item in explanations)
    to_fit = [item.address for item in explanations if item.step is Step.FIT]
    predicted = {_shared(job) for job in jobs if not job.missing}  # by then
    lacking = {_shared(job): job.address for job in jobs if _shared(job) not in predicted}
    return Forecast(
        profile,
        {step: steps[step] for step in Step if steps[step]},
        _work(to_fit, ways),
        _work([*to_fit, *lacking.values()], ways),
    )


def _shared(job: Job) -> str:
    """Return what the jobs that share a fit have in common."""
    return job.training_key or job.fit_key


class _Way(NamedTuple):
    """A way to know how long a fit takes."""

    basis: Basis
    durations: Durations
    of: slice
    """Which of the kinds that a job belongs to count."""


def _ways(out: Path, profile: str) -> tuple[_Way, ...]:
    entrant, anything = slice(0, 2), slice(2, 3)
    records = Store(out).records() if Store.is_run(out) else []
    return (
        _Way(Basis.RECORDS, of_records(records), entrant),
        _Way(Basis.TYPICAL, typical(profile), entrant),
        _Way(Basis.MEAN, typical(profile), anything),
    )


def _work(fits: Iterable[Address], ways: Sequence[_Way]) -> Work:
    estimates = [_estimate(address, ways) for address in fits]
    seconds = tuple(seconds for _, seconds in estimates)
    return Work(seconds, Counter(basis for basis, _ in estimates))


def _estimate(address: Address, ways: Sequence[_Way]) -> tuple[Basis, float]:
    """Return how long a fit takes by the first way that knows; the last always does."""
    kinds = alike(address)
    way = next(way for way in ways if way.durations.knows(kinds[way.of]))
    return way.basis, way.durations.expected(kinds[way.of])
