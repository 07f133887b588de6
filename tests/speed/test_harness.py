"""What the harness spends on a job of a model that does nothing (`tox -e speed`).

Stage by stage, and as a whole in runs of many jobs on two workers, beside an empty function's call.
"""

import math
import os
import time
from pathlib import Path

import pytest
from rich.console import Console

from mocapbench import benchmark as bench
from mocapbench.basics.child import call_in_child
from mocapbench.benchmark.runs import evaluate
from mocapbench.benchmark.runs.execution.spool import Spool, SpooledArchive
from mocapbench.benchmark.runs.job import Work

PLUGIN = Path(__file__).with_name("no_op.py")
SIZES = {
    "harness: toy": ("toy-interpolation-1", "test 1"),
    "harness: recordings": ("walking-interpolation", "synthetic observed 40"),
}
N_JOBS = 1000
N_JOBS_UNTIMED = 20
"""Where nothing is timed, a few show that it works."""
N_WORKERS = 2


def _nothing():
    """Compute nothing."""


def _jobs(size, folds):
    task, case = SIZES[size]
    bench.load_plugin(PLUGIN)
    request = bench.Request(tasks=(task,), cases=(case,), models=("no-op",), folds=folds)
    return bench.plan(request, bench.archive_at())


def _config():
    about = bench.provenance(["mocapbench"], 1)
    return bench.WorkerConfig((), (PLUGIN,), 600.0, math.inf, 1, about)


@pytest.fixture
def stages(tmp_path, request):
    """Return what is done for one job, by name."""
    (job,) = _jobs(request.getfixturevalue("size"), 1)
    config, spool, store = _config(), Spool(tmp_path), bench.RunDirectory.create(tmp_path / "run")
    libraries = bench.archive_at().libraries
    spool.add(bench.archive_at(), job.digests)
    archive = SpooledArchive(libraries, spool, job.digests)
    problem = bench.TASKS.get(job.address.task).case(job.address.case).problem
    outcome = evaluate.evaluate(Work(job, None), config, archive)
    record, fit = outcome.record, outcome.fit
    assert fit is not None
    return {
        "empty call": _nothing,
        "read": lambda: SpooledArchive(libraries, spool, job.digests),
        "pose": lambda: problem(job.seeds, archive),
        "evaluate": lambda: evaluate.evaluate(Work(job, None), config, archive),
        "score": lambda: evaluate.evaluate(Work(job, fit), config, archive),
        "fork": lambda: call_in_child(_nothing, timeout=60),
        "keep predictions": lambda: store.save_fit(job.fit_key, fit),
        "keep record": lambda: store.save(record),
        "look up record": lambda: store.load(job.key),
    }


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize(
    "how",
    [
        *("empty call", "read", "pose", "evaluate", "score"),
        pytest.param("fork", marks=pytest.mark.forks),
        *("keep predictions", "keep record", "look up record"),
    ],
)
def test_a_stage(benchmark, stages, size, how):
    benchmark.group = size
    stages["keep record"]()
    benchmark.pedantic(stages[how], rounds=50, warmup_rounds=2)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("how", ["run"])
def test_a_run(benchmark, tmp_path, size, how):
    benchmark.group = size
    jobs = _jobs(size, N_JOBS if benchmark.enabled else N_JOBS_UNTIMED)
    store, backend = bench.RunDirectory.create(tmp_path / "run"), bench.ThisMachine(N_WORKERS)
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        console, began = Console(file=nowhere), time.perf_counter()
        run = benchmark.pedantic(
            bench.run, (jobs, store, _config()), {"backend": backend, "console": console}, rounds=1
        )
    assert {record.status for record in run} == {bench.Status.OK}
    wall = (time.perf_counter() - began) / len(jobs)
    benchmark.extra_info["wall_ms"] = 1e3 * wall
    benchmark.extra_info["core_ms"] = 1e3 * wall * N_WORKERS
