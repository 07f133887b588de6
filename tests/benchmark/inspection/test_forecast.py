"""What a planned run will do, and how long it is expected to take."""

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.inspection.explanation import Step, explain
from mocapbench.benchmark.inspection.forecast import (
    expect_work,
    forecast_lines,
    lacking,
    lacking_line,
)
from mocapbench.benchmark.inspection.work import Basis, wall_time
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.request import Request

TASKS = ("toy-interpolation-1", "missing-frames")


def jobs(models, tasks=TASKS, profile="quick", folds=2):
    return plan(Request(profile, tasks, models, folds=folds), archive_at())


def done(store, job, seconds):
    store.save(job.record(Status.OK, fit_seconds=seconds, predict_seconds=0.0))


def steps_of(planned, out):
    return Counter(explanation.step for explanation in explain(planned, out))


def bases_of(work):
    return Counter(basis for _, basis in work)


def work_of(planned, out, profile="quick"):
    """Return the fits with the recordings that are here, and with all."""
    return expect_work(planned, explain(planned, out), out, profile)


def lines_of(planned, out, n_workers, profile="quick"):
    return [*forecast_lines(planned, explain(planned, out), out, profile, n_workers)]


def test_without_records_the_developers_know(tmp_path):
    planned = jobs(("knn",), TASKS[:1])
    now, _ = work_of(planned, tmp_path / "none")
    assert steps_of(planned, tmp_path / "none") == {Step.FIT: len(planned)}
    assert bases_of(now) == {Basis.TYPICAL: len(planned)}
    assert all(seconds > 0 for seconds, _ in now)


def test_records_of_the_entrant_go_first_and_what_is_done_takes_no_time(tmp_path):
    first, *rest = planned = jobs(("knn", "trivial"), TASKS[:1])
    store = RunDirectory.create(tmp_path / "run")
    done(store, first, 7.0)
    now, _ = work_of(planned, store.path)
    others = sum(job.address.label == first.address.label for job in rest)
    assert steps_of(planned, store.path) == {Step.SKIP: 1, Step.FIT: len(rest)}
    assert bases_of(now) == {Basis.RECORDS: others, Basis.TYPICAL: len(rest) - others}
    assert now.count((7.0, Basis.RECORDS)) == others


def test_jobs_that_share_a_fit_count_as_one(tmp_path):
    request = Request("smoke", ("missing-frames",), ("knn",), ("synthetic*",), folds=3)
    first, *rest = planned = plan(request, archive_at())
    now, _ = work_of(planned, tmp_path / "none", "smoke")
    assert steps_of(planned, tmp_path / "none") == {Step.FIT: 1, Step.PREDICT: len(rest)}
    assert len(now) == 1
    store = RunDirectory.create(tmp_path / "run")
    done(store, first, 7.0)  # its fitted model has ended with the run
    assert steps_of(planned, store.path) == {
        Step.SKIP: 1,
        Step.FIT: 1,
        Step.PREDICT: len(rest) - 1,
    }


def test_an_entrant_that_nobody_ran_is_expected_to_take_the_mean(tmp_path):
    (job, *_) = planned = jobs(("knn",), TASKS[:1], folds=1)
    renamed = [type(job)(**{**vars(job), "address": job.address._replace(label="new")})]
    now, _ = work_of(renamed, tmp_path)
    assert bases_of(now) == {Basis.MEAN: 1}
    assert len(planned) > 1


def test_a_fit_that_cases_share_counts_once(tmp_path):
    planned = jobs(("replay",), ("walking-synthesis",), profile="paper", folds=1)
    fits = {job.fit_key for job in planned}
    _, with_all = work_of(planned, tmp_path / "none", "paper")
    assert len(fits) < len(planned)
    assert len(with_all) == len(fits)
    first_run = explain(planned, tmp_path / "none")
    RunDirectory.create(tmp_path / "empty")
    assert [e.step for e in explain(planned, tmp_path / "empty")] == [e.step for e in first_run]


@pytest.mark.usefixtures("nothing_here")
def test_missing_recordings_are_counted_with_and_without(tmp_path):
    planned = jobs(("trivial",))
    (now, with_all), short = work_of(planned, tmp_path), sum(bool(job.missing) for job in planned)
    assert steps_of(planned, tmp_path)[Step.CANNOT] == short > 0
    trainings = {job.training_key for job in planned if job.missing}
    assert "" not in trainings
    assert len(with_all) == len(now) + len(trainings)
    assert "cmu:35_03" in lacking(planned)
    assert not any(uri.startswith("gait:") for uri in lacking(planned))
    line = lacking_line(planned, "do this")
    assert line == f"data missing: {short} of {len(planned)} jobs lack 11 recordings; do this"
    lines = lines_of(planned, tmp_path, 2)
    assert any(line.startswith("time with the missing recordings: about") for line in lines)


@pytest.mark.parametrize(("profile", "limited"), [("quick", False), ("paper", True)])
def test_the_words_say_how_the_time_is_known(tmp_path, profile, limited):
    planned = jobs(("knn",), TASKS[:1], profile)
    lines = lines_of(planned, tmp_path / "run", 2, profile)
    assert lines[0] == f"in {tmp_path / 'run'}: {len(planned)} to fit and score"
    assert "with 2 jobs at once" in lines[1]
    assert lines[2] == (
        f"estimated by the entrant's mean in a run of the developers ({len(planned)} fits)"
    )
    assert any("lower limit" in line for line in lines) is limited


def test_a_cluster_decides_how_many_jobs_run_at_once(tmp_path):
    planned = jobs(("knn",), TASKS[:1])
    text = " ".join(lines_of(planned, tmp_path / "run", None))
    assert "divided among the workers of the cluster" in text
    assert "at once" not in text


def test_a_run_that_is_done_takes_no_time(tmp_path):
    planned = jobs(("knn",), TASKS[:1])
    store = RunDirectory.create(tmp_path / "run")
    for job in planned:
        done(store, job, 1.0)
    lines = lines_of(planned, store.path, 2)
    assert lines == [f"in {store.path}: {len(planned)} done already"]


@given(st.lists(st.floats(0.0, 1e3)), st.integers(1, 64))
def test_no_run_is_shorter_than_its_longest_fit_or_longer_than_its_work(seconds, n_workers):
    assert max(seconds, default=0.0) <= wall_time(seconds, n_workers)
    assert wall_time(seconds, n_workers) <= sum(seconds) * (1 + 1e-12)
    assert wall_time(seconds, 1) == pytest.approx(sum(seconds))
