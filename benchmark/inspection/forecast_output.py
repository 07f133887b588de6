"""A forecast of a run in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.explanation import Step
from mocapbench.benchmark.inspection.fit_seconds import MEASURED
from mocapbench.benchmark.inspection.forecast import Forecast
from mocapbench.benchmark.inspection.work import Basis
from mocapbench.benchmark.runs.job import Job

__all__ = ["forecast_lines", "lacking", "lacking_line"]

_STEPS = {
    Step.SKIP: "done already",
    Step.FIT: "to fit and score",
    Step.PREDICT: "to predict by a shared fit",
    Step.SCORE: "only to score",
    Step.CANNOT: "without their recordings",
}


def lacking(jobs: Sequence[Job]) -> tuple[str, ...]:
    """Return the addresses of the recordings that ``jobs`` need and that are not at hand."""
    return tuple(dict.fromkeys(uri for job in jobs for uri in job.missing))


def lacking_line(jobs: Sequence[Job], remedy: str) -> str:
    """Return how many of ``jobs`` lack recordings, and what to do about it."""
    count = sum(bool(job.missing) for job in jobs)
    recordings = format_count(len(lacking(jobs)), "recording")
    return f"data missing: {count} of {len(jobs)} jobs lack {recordings}; {remedy}"


def forecast_lines(forecast: Forecast, out: Path, n_workers: int | None) -> Iterator[str]:
    """Yield what a run will do, how long it takes, and how that is known.

    Parameters
    ----------
    forecast : Forecast
    out : Path
        The run directory.
    n_workers : int or None
        How many jobs run at once; None if a cluster decides.
    """
    steps = ", ".join(f"{count} {_STEPS[step]}" for step, count in forecast.steps.items())
    yield f"in {out}: {steps or 'nothing to do'}"
    if not forecast.with_all.seconds:
        return
    if forecast.now.seconds:
        yield f"time: {forecast.now.in_words(n_workers)}"
    if forecast.with_all != forecast.now:
        yield f"time with the missing recordings: {forecast.with_all.in_words(n_workers)}"
    yield from _describe_bases(forecast)


def _describe_bases(forecast: Forecast) -> Iterator[str]:
    by = forecast.with_all.known_by
    fits = (f"{basis} ({format_count(by[basis], 'fit')})" for basis in Basis if by[basis])
    yield f"estimated by {', by '.join(fits)}"
    measured = MEASURED[forecast.profile]
    if measured != forecast.profile and by.keys() - {Basis.RECORDS}:
        longer = f"the developers ran {measured}, whose fits are shorter than {forecast.profile}'s"
        yield f"{longer}: take the time as a lower limit"
