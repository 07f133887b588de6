"""A worker does many jobs, but not without end."""

import os
import time

import pytest
from pebble import ProcessExpired

from mocapbench.benchmark.runs.execution import worker_pool


@pytest.fixture
def pool(request):
    """Return a function that starts workers, which end with the test."""

    def pool(n_workers, **options):
        workers = worker_pool.WorkerPool(n_workers, **options)
        request.addfinalizer(workers.stop)
        return workers

    return pool


def test_a_worker_is_replaced_after_so_many_jobs_and_none_is_lost(monkeypatch, pool):
    monkeypatch.setattr(worker_pool, "_MOST_JOBS", 3)
    workers = pool(1)
    futures = [workers.submit(os.getpid) for _ in range(8)]
    pids = [future.result(timeout=60) for future in futures]
    assert [pids.count(pid) for pid in dict.fromkeys(pids)] == [3, 3, 2]


@pytest.mark.slow
@pytest.mark.parametrize("code", [0, 7])
def test_a_worker_that_exits_in_a_job_ends_that_job_and_no_other(code, pool):
    workers = pool(1)
    futures = [workers.submit(*job) for job in ((os._exit, code), (abs, -1), (os._exit, code))]
    ended = [future.exception(timeout=60) for future in futures]
    assert [getattr(error, "exitcode", None) for error in ended] == [code, None, code]
    assert isinstance(ended[0], ProcessExpired)
    assert futures[1].result() == 1


def test_a_job_that_lasts_too_long_is_killed_and_no_other(monkeypatch, pool):
    """The clock of the day, which may be set, has no say."""
    monkeypatch.setattr(time, "time", lambda: 10.0 * time.monotonic())
    workers = pool(1, timeout=2.0)
    futures = [workers.submit(*job) for job in ((time.sleep, 600), (time.sleep, 0.5), (abs, -1))]
    assert isinstance(futures[0].exception(timeout=60), TimeoutError)
    assert [future.result(timeout=60) for future in futures[1:]] == [None, 1]


def test_a_result_that_comes_after_its_worker_has_ended_is_waited_for(monkeypatch, pool):
    """Every worker ends with its only job; results are larger than what a pipe holds."""
    monkeypatch.setattr(worker_pool, "_MOST_JOBS", 1)
    workers = pool(2)
    futures = [workers.submit(bytes, 10**7) for _ in range(4)]
    assert [len(future.result(timeout=60)) for future in futures] == [10**7] * 4
