"""Every job once, the longest first, and none before the predictions that it shares."""

import time
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.runs.execution.job_queue import JobQueue
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.tasks.address import Address


def _job(number, label="a", fit_key="", training_key="", case="case"):
    address = Address("task", 1, case, number, label)
    fit_key = fit_key or f"fit {number}"
    return SimpleNamespace(
        key=str(number), fit_key=fit_key, training_key=training_key, address=address
    )


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
        queue.finish(job, seconds[job.key])
    assert sorted(taken) == sorted(job.key for job in jobs)
    assert queue.time_left(n_workers) == 0


@given(st.lists(st.tuples(st.integers(0, 6), st.booleans()), max_size=20), st.integers(1, 4))
def test_a_shared_model_is_fitted_by_one_job_before_the_others_start(chosen, n_workers):
    """Fits may share predictions too, and some predictions are in the store already."""
    jobs = [_job(n, "a", f"fit {fit}", f"model {fit // 3}") for n, (fit, _) in enumerate(chosen)]
    stored = {f"fit {fit}" for fit, is_stored in chosen if is_stored}
    queue, running, fits, models, n_taken = JobQueue(jobs), [], [], set(), 0
    while True:
        while len(running) < n_workers and (job := queue.take()):
            n_taken += 1
            if job.fit_key not in stored and job.training_key not in models:
                fits.append(job.training_key)
            running.append((job, job.fit_key in stored))
        if not running:
            break
        job, rescored = running.pop(0)
        if not rescored:
            models.add(job.training_key)
        stored.add(job.fit_key)
        queue.finish(job, 1.0, rescored=rescored)
    assert n_taken == len(jobs)
    assert len(fits) == len(set(fits))


def test_once_each_entrant_is_known_the_slowest_go_first():
    queue = JobQueue([_job(n, label) for n, label in enumerate("aabbccc")])
    for label, seconds in {"a": 1.0, "b": 3.0, "c": 2.0}.items():
        job = queue.take()
        assert job.address.label == label
        queue.finish(job, seconds)
    assert [queue.take().address.label for _ in range(4)] == ["b", "c", "c", "a"]
    assert queue.take() is None


def test_cases_take_different_times(monkeypatch):
    """A case of which no job has ended is expected to take what others of its entrant do."""
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    cases = ["long", "long", "short", "short", "short"]
    queue = JobQueue([_job(n, case=case) for n, case in enumerate(cases)])
    first = queue.take()  # from the middle
    assert first.address.case == "short"
    queue.finish(first, 1.0)
    assert queue.time_left(1) == pytest.approx(4 * 1)
    second = queue.take()
    assert second.address.case == "long"
    queue.finish(second, 100.0)
    assert queue.time_left(1) == pytest.approx(100 + 2 * 1)
    assert [queue.take().address.case for _ in range(3)] == ["long", "short", "short"]


def test_cases_of_many_jobs_are_tried_first(monkeypatch):
    """So that the time left is right before all of the slowest have ended."""
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    seconds = {"x": 1.0, "y": 10.0, "z": 5.0}
    queue = JobQueue([_job(n, case=case) for n, case in enumerate("xyz" * 30)])
    first = [queue.take() for _ in range(4)]
    assert {job.address.case for job in first} == set(seconds)
    for job in first:
        queue.finish(job, seconds[job.address.case])
    left = queue.time_left(1)
    whole = 30 * sum(seconds.values()) - sum(seconds[job.address.case] for job in first)
    assert left == pytest.approx(whole)


def test_how_long_it_takes_to_predict_by_shared_models_is_soon_known_of_each_case(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    seconds = {"x": 1.0, "y": 10.0, "z": 5.0}
    queue = JobQueue(
        [_job(n, training_key=f"model {case}", case=case) for n, case in enumerate("xyz" * 30)]
    )
    left, n_taken = 30 * sum(seconds.values()), 0
    while n_taken < 10 or queue.time_left(1) != pytest.approx(left):
        job = queue.take()
        queue.finish(job, seconds[job.address.case])
        left -= seconds[job.address.case]
        n_taken += 1
        assert n_taken <= 10


def test_a_run_that_goes_on_knows_how_long_jobs_took_before(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    before = [
        SimpleNamespace(
            address=Address("task", 1, "case", 9, label), status=status, seconds=seconds
        )
        for label, status, seconds in [
            *(("a", Status.OK, 3), ("b", Status.OK, 7)),
            *(("b", "failed", 1), ("a", Status.OK, None)),
        ]
    ]
    queue = JobQueue([_job(n, label) for n, label in enumerate("ababc")], before)
    assert queue.time_left(1) == pytest.approx(2 * 3 + 2 * 7 + 5)  # c: the mean of all
    assert [queue.take().address.label for _ in range(5)] == ["c", "b", "b", "a", "a"]


def test_the_time_left_follows_from_the_jobs_most_alike(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    queue = JobQueue([_job(n, label) for n, label in enumerate("aaabbb")])
    for seconds in (10.0, 1.0):
        queue.finish(queue.take(), seconds)
    assert queue.time_left(1) == pytest.approx(2 * 10 + 2 * 1)
    assert queue.time_left(2) == pytest.approx(11)
    assert queue.time_left(100) == pytest.approx(10)  # no less than the longest of them


def test_jobs_that_wait_for_what_they_share_count_too(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    fits = [f"fit {n // 2}" for n in range(6)]
    queue = JobQueue([_job(n, "a", fit, "model") for n, fit in enumerate(fits)])
    assert queue.time_left(1) == 0  # nothing is known yet
    queue.finish(queue.take(), 10.0)  # frees a job to score and two to predict
    assert queue.time_left(1) == pytest.approx(5 * 10)
    queue.finish(queue.take(), 1.0)
    queue.finish(queue.take(), 3.0)
    left = queue.time_left(1)
    assert 0 < left < 3 * 10
    while job := queue.take():
        queue.finish(job, 1.0)
    assert queue.time_left(1) == 0


def test_a_running_job_counts_for_what_is_left_of_it(monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    queue = JobQueue([_job(0), _job(1)])
    queue.finish(queue.take(), 10.0)
    queue.take()
    now = 4.0
    assert queue.time_left(1) == pytest.approx(6)
    now = 40.0
    assert queue.time_left(1) == 0


@pytest.mark.parametrize("n_jobs", [1, 2, 5, 6])
def test_the_first_of_a_kind_is_from_its_middle_and_the_others_keep_their_order(n_jobs):
    queue, middle = JobQueue([_job(n) for n in range(n_jobs)]), n_jobs // 2
    order = [job.address.fold for job in iter(queue.take, None)]
    assert order == [middle, *(n for n in range(n_jobs) if n != middle)]


def test_to_predict_is_expected_to_take_no_longer_than_to_fit_too(monkeypatch):
    """What is left of other entrants, which may take long, says little of one not yet tried."""
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    jobs = [_job(n, label, f"fit {n}", f"model {label}") for n, label in enumerate("aabb")]
    queue = JobQueue(jobs)
    queue.finish(queue.take(), 100.0)
    queue.finish(queue.take(), 0.1)
    queue.finish(queue.take(), 90.0)  # the other job of a, which predicts by its model
    assert queue.time_left(1) == pytest.approx(0.1)


def test_jobs_are_expected_to_take_no_less_than_one_that_runs_has_taken(monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    queue = JobQueue([_job(n) for n in range(4)])
    queue.take()
    now = 20.0
    assert queue.time_left(1) == pytest.approx(3 * 20)
