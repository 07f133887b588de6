"""What a planned run will do: how many jobs of which kind, for how long, and how that is known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.explanation import Explanation, Step
from mocapbench.benchmark.inspection.fit_seconds import MEASURED
from mocapbench.benchmark.inspection.work import Basis, ExpectedWork, work_of
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.job import Job

__all__ = ["expect_work", "forecast_lines", "lacking", "lacking_line"]

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


def forecast_lines(
    jobs: Sequence[Job],
    explanations: Sequence[Explanation],
    out: Path,
    profile: str,
    n_workers: int | None,
) -> Iterator[str]:
    """Yield what a run will do, how long it takes, and how that is known.

    Parameters
    ----------
    jobs, explanations, out, profile
        See `expect_work`.
    n_workers : int or None
        How many jobs run at once; None if a cluster decides.
    """
    counts = Counter(item.step for item in explanations)
    steps = ", ".join(f"{counts[step]} {_STEPS[step]}" for step in Step if counts[step])
    yield f"in {out}: {steps or 'nothing to do'}"
    now, with_all = expect_work(jobs, explanations, out, profile)
    if not with_all.seconds:
        return
    if now.seconds:
        yield f"time: {now.in_words(n_workers)}"
    if with_all != now:
        yield f"time with the missing recordings: {with_all.in_words(n_workers)}"
    yield from _describe_bases(with_all, profile)


def expect_work(
    jobs: Sequence[Job], explanations: Sequence[Explanation], out: Path, profile: str
) -> tuple[ExpectedWork, ExpectedWork]:
    """Return the work with the recordings that are here, and with all that the jobs need.

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
    records = RunDirectory(out).records() if RunDirectory.is_run(out) else []
    to_fit = [item.address for item in explanations if item.step is Step.FIT]
    predicted = {_fit_shared_by(job) for job in jobs if not job.missing}  # by then
    without = {
        _fit_shared_by(job): job.address for job in jobs if _fit_shared_by(job) not in predicted
    }
    return (
        work_of(to_fit, records, profile),
        work_of([*to_fit, *without.values()], records, profile),
    )


def _fit_shared_by(job: Job) -> str:
    """Return what the jobs that share a fit have in common."""
    return job.training_key or job.fit_key


def _describe_bases(work: ExpectedWork, profile: str) -> Iterator[str]:
    by = work.known_by
    fits = (f"{basis} ({format_count(by[basis], 'fit')})" for basis in Basis if by[basis])
    yield f"estimated by {', by '.join(fits)}"
    measured = MEASURED[profile]
    if measured != profile and by.keys() - {Basis.RECORDS}:
        longer = f"the developers ran {measured}, whose fits are shorter than {profile}'s"
        yield f"{longer}: take the time as a lower limit"
