"""Seconds and bytes of a run directory with N records: ``python docs/evidence/many_records.py N``.

The jobs are those of toy-interpolation-1 with as many folds as it takes. Nothing is fitted: one
real outcome of each entrant stands for all its jobs, with scores that vary from fold to fold.
"""

from __future__ import annotations

import math
import os
import resource
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from rich.console import Console

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.job import Work

MODELS = ("trivial", "cubic-spline", "knn", "nn", "oracle")
TASK = "toy-interpolation-1"


@contextmanager
def timed(what: str, n_jobs: int) -> Iterator[None]:
    """Print the seconds of a block, for each 10,000 jobs, and the peak memory until then."""
    began = time.perf_counter()
    yield
    seconds = time.perf_counter() - began
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{what:24}{seconds:9.1f} s {seconds / n_jobs * 1e4:9.2f} s/10⁴ {peak:9.0f} MB", flush=True
    )


def main(n_jobs: int, folder: Path) -> None:
    """Measure each step once."""
    archive, rng = bench.archive_at(), np.random.default_rng(0)
    n_cases = len(bench.TASKS.get(TASK).cases)
    folds = -(-n_jobs // (n_cases * len(MODELS)))
    request = bench.Request("paper", (TASK,), MODELS, folds=folds)
    with timed("plan", n_jobs):
        jobs = bench.plan(request, archive)
    about = bench.provenance(["mocapbench"], 1)
    config = bench.WorkerConfig((), (), 600.0, math.inf, 1, about)
    outcomes = {
        job.address.label: evaluate(Work(job, None), config, archive)
        for job in jobs
        if job.address.fold == 0 and job.address.case == jobs[0].address.case
    }
    store = bench.RunDirectory.create(folder / "run")
    with timed("write", n_jobs):
        store.save_plan(bench.plan_document(jobs, provenance=about, workers=1))
        for job in jobs:
            outcome = outcomes[job.address.label]
            record, fit = outcome.record, outcome.fit
            assert fit is not None
            scores = {name: value * rng.uniform(0.9, 1.1) for name, value in record.scores.items()}
            mine = replace(
                record, key=job.key, fit_key=job.fit_key, address=job.address, scores=scores
            )
            store.save_fit(job.fit_key, fit)
            store.save(mine)
    with timed("resume", n_jobs), Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        backend = bench.ThisMachine(1)
        records = bench.run(jobs, store, config, backend=backend, console=Console(file=nowhere))
    with timed("tables of an export", n_jobs):
        bench.score_table(records)
        bench.job_table(records)
    with timed("report", n_jobs):
        figures = bench.illustrations(records, store, archive)
        page = reports.render(bench.bundle(records, about, figures, None))
    for part in ("records", "predictions"):
        files = [path.stat().st_size for path in (folder / "run" / part).rglob("*.*")]
        most = max(len([*each.iterdir()]) for each in (folder / "run" / part).iterdir())
        print(f"{part}: {len(files)} files, {np.mean(files):.0f} bytes each, {most} in a folder")
    print(f"report: {len(page) / 2**20:.1f} MiB")


if __name__ == "__main__":
    with TemporaryDirectory() as place:
        main(int(sys.argv[1]), Path(place))
