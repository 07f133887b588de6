"""A worker does many jobs, but not without end."""

import os

from mocapbench.benchmark.runs.execution import worker_pool


def test_a_worker_is_replaced_after_so_many_jobs_and_none_is_lost(monkeypatch):
    monkeypatch.setattr(worker_pool, "_MOST_JOBS", 3)
    pool = worker_pool.WorkerPool(1)
    futures = [pool.submit(os.getpid) for _ in range(8)]
    pids = [future.result(timeout=60) for future in futures]
    pool.stop()
    assert [pids.count(pid) for pid in dict.fromkeys(pids)] == [3, 3, 2]
