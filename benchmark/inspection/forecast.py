"""What a planned run will do: how many jobs of which kind, for how long, and how that is known."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from rich.table import Column, Table

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.explanation import Explanation, Step, explain
from mocapbench.benchmark.inspection.work import (
    MEASURED,
    Basis,
    Estimate,
    describe_work,
    estimate_fits,
)
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.job import Job

__all__ = [
    "expect_work",
    "forecast_lines",
    "forecast_text",
    "lacking",
    "lacking_line",
    "plan_table",
]


def plan_table(planned: Sequence[Job]) -> Table:
    """Return the tasks with their cases, entrants and folds, those together that have the same."""
    table = Table(Column(no_wrap=True), Column(overflow="fold"), show_header=False, box=None)
    for (task, labels, folds), cases in _rows(planned).items():
        factors = ((cases, "case"), (labels, "entrant"), (range(folds), "fold"))
        product = " × ".join(format_count(len(several), noun) for several, noun in factors)
        n_jobs = format_count(len(cases) * len(labels) * folds, "job")
        table.add_row(task, f"{n_jobs} = {product}")
        table.add_row("  cases", ", ".join(cases))
        table.add_row("  entrants", ", ".join(labels))
    return table


def forecast_text(
    planned: Sequence[Job], profile: str, out: Path, n_workers: int | None, remedy: str
) -> Iterator[str]:
    """Yield how many jobs there are, how long they take, and which recordings are missing.

    Parameters
    ----------
    planned : sequence of Job
    profile : str
    out : Path
        The run directory.
    n_workers : int or None
        How many jobs would run at once; None if a cluster decides.
    remedy : str
        What to do about missing recordings.
    """
    yield format_count(len(planned), "job")
    yield from forecast_lines(planned, explain(planned, out), out, profile, n_workers)
    if lacking(planned):
        yield lacking_line(planned, remedy)


def _rows(planned: Sequence[Job]) -> Mapping[tuple[str, tuple[str, ...], int], list[str]]:
    """Return the cases by what they have in common: task, entrants and number of folds."""
    labels: dict[tuple[str, str], dict[str, None]] = defaultdict(dict)
    folds: dict[tuple[str, str], set[int | None]] = defaultdict(set)
    for address in (job.address for job in planned):
        labels[address.task, address.case][address.label] = None
        folds[address.task, address.case].add(address.fold)
    rows: dict[tuple[str, tuple[str, ...], int], list[str]] = defaultdict(list)
    for (task, case), entrants in labels.items():
        rows[task, tuple(entrants), len(folds[task, case])].append(case)
    return rows


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
    if not with_all:
        return
    if now:
        yield f"time: {describe_work(now, n_workers)}"
    if with_all != now:
        yield f"time with the missing recordings: {describe_work(with_all, n_workers)}"
    yield from _describe_bases(with_all, profile)


def expect_work(
    jobs: Sequence[Job], explanations: Sequence[Explanation], out: Path, profile: str
) -> tuple[list[Estimate], list[Estimate]]:
    """Return the fits with the recordings that are here, and with all that the jobs need.

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
        estimate_fits(to_fit, records, profile),
        estimate_fits([*to_fit, *without.values()], records, profile),
    )


def _fit_shared_by(job: Job) -> str:
    """Return what the jobs that share a fit have in common."""
    return job.training_key or job.fit_key


def _describe_bases(work: Sequence[Estimate], profile: str) -> Iterator[str]:
    by = Counter(basis for _, basis in work)
    fits = (f"{basis} ({format_count(by[basis], 'fit')})" for basis in Basis if by[basis])
    yield f"estimated by {', by '.join(fits)}"
    measured = MEASURED[profile]
    if measured != profile and by.keys() - {Basis.RECORDS}:
        longer = f"the developers ran {measured}, whose fits are shorter than {profile}'s"
        yield f"{longer}: take the time as a lower limit"
