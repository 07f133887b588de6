"""What a planned run will do: how many jobs of which kind, and for how long."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mocapbench.benchmark.inspection.explanation import Explanation, Step
from mocapbench.benchmark.inspection.work import ExpectedWork, work_of
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.job import Job

__all__ = ["Forecast", "forecast"]


@dataclass(frozen=True)
class Forecast:
    """What a planned run will do.

    Parameters
    ----------
    profile : str
    steps : mapping of Step to int
        How many jobs are skipped, fitted, only scored, or cannot run.
    now : ExpectedWork
        With the recordings that are here.
    with_all : ExpectedWork
        With all recordings that the jobs need.
    """

    profile: str
    steps: Mapping[Step, int]
    now: ExpectedWork
    with_all: ExpectedWork


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
    records = RunDirectory(out).records() if RunDirectory.is_run(out) else []
    steps = Counter(item.step for item in explanations)
    to_fit = [item.address for item in explanations if item.step is Step.FIT]
    predicted = {_fit_shared_by(job) for job in jobs if not job.missing}  # by then
    lacking = {
        _fit_shared_by(job): job.address for job in jobs if _fit_shared_by(job) not in predicted
    }
    return Forecast(
        profile,
        {step: steps[step] for step in Step if steps[step]},
        work_of(to_fit, records, profile),
        work_of([*to_fit, *lacking.values()], records, profile),
    )


def _fit_shared_by(job: Job) -> str:
    """Return what the jobs that share a fit have in common."""
    return job.training_key or job.fit_key
