"""Every job once, the longest first, and none before the predictions that it shares."""

import time
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.runs.execution.job_queue import JobQueue
from mocapbench.benchmark.tasks.address import Address


def _job(number, label="a", fit_key=""):
    address = Address("task", 1, "case", number, label)
    return SimpleNamespace(key=str(number), fit_key=fit_key or f"fit {number}", address=address)


JOBS = st.lists(
    st.tuples(st.sampled_from("abc"), st.integers(0, 5), st.floats(0, 1e3)), max_size=20
)


@given(JOBS, st.integers(1, 4))
def test_every_job_is_taken_once_whatever_ends_first(chosen, n_workers):
    jobs = [_job(n, label, f"{label} {fit}") for n, (label, fit, _) in enumerate(chosen)]
    seconds = {str(n): each for n, (_, _, each) in enumerate(chosen)}
    queue, taken, running, answered = JobQueue(jobs), [], [], set()
    while True:
        while len(running) < n_workers and (job := queue.take()):
            alone = job.fit_key not in {other.fit_key for other in running}
            assert alone or job.fit_key in answered
            taken.append(job.key)
            running.append(job)
        if not running:
            break
        job = running.pop(0)
        answered.add(job.fit_key)
        queue.ended(job, seconds[job.key])
    assert sorted(taken) == sorted(job.key for job in jobs)
    assert queue.time_left(n_workers) == 0


def test_once_each_entrant_is_known_the_slowest_go_first():
    queue = JobQueue([_job(n, label) for n, label in enumerate("aabbccc")])
    for label, seconds in {"a": 1.0, "b": 3.0, "c": 2.0}.items():
        job = queue.take()
        assert job.address.label == label
        queue.ended(job, seconds)
    assert [queue.take().address.label for _ in range(4)] == ["b", "c", "c", "a"]
    assert queue.take() is None


def test_the_time_left_follows_from_the_jobs_most_alike(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    queue = JobQueue([_job(n, label) for n, label in enumerate("aaabbb")])
    for seconds in (10.0, 1.0):
        queue.ended(queue.take(), seconds)
    assert queue.time_left(1) == pytest.approx(2 * 10 + 2 * 1)
    assert queue.time_left(2) == pytest.approx(11)
    assert queue.time_left(100) == pytest.approx(10)  # no less than the longest of them


def test_a_running_job_counts_for_what_is_left_of_it(monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    queue = JobQueue([_job(0), _job(1)])
    queue.ended(queue.take(), 10.0)
    queue.take()
    now = 4.0
    assert queue.time_left(1) == pytest.approx(6)
    now = 40.0
    assert queue.time_left(1) == 0
