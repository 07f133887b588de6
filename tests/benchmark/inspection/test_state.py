"""The state of a run is what its plan and its records say, whoever asks, and when."""

import re
from datetime import UTC, datetime, timedelta

import pytest

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.inspection.explanation import explain
from mocapbench.benchmark.inspection.forecast import expect_work, forecast_lines
from mocapbench.benchmark.inspection.output import state_lines
from mocapbench.benchmark.inspection.state import run_state
from mocapbench.benchmark.inspection.work import Basis
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.plan_document import plan_document
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.request import Request

ROWS = [(task, "a", label, fold) for task in "tu" for label in "xy" for fold in (0, 1, 2)]
NOW = datetime(2026, 1, 1, 12, tzinfo=UTC)


def seconds_left(state):
    return [seconds for seconds, _ in state.work_left]


def test_jobs_are_counted_by_task(write_run, tmp_path):
    statuses = {
        ROWS[0]: Status.FAILED,
        ROWS[1]: Status.TIMEOUT,
        ROWS[2]: Status.OUT_OF_MEMORY,
        ROWS[3]: Status.DATA_MISSING,
    }
    store = RunDirectory(write_run(tmp_path / "run", ROWS, statuses=statuses, left=ROWS[6:8]))
    state = run_state(store)
    assert list(state.tasks) == ["t", "u"]
    assert state.tasks["t"] == {"done": 2, "failed": 3, "data missing": 1}
    assert state.tasks["u"] == {"done": 4, "left": 2}
    assert state.total == {"done": 6, "failed": 3, "data missing": 1, "left": 2}
    assert state.total.total() == len(ROWS)


def test_a_run_is_running_interrupted_or_finished(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS, left=ROWS[:2]))
    with store.locked():
        assert run_state(RunDirectory(store.path)).name == "running"
    assert run_state(store).name == "interrupted"
    assert run_state(RunDirectory(write_run(tmp_path / "all", ROWS))).name == "finished"


@pytest.mark.parametrize(("left", "expected"), [(0, 0.0), (1, 2.0), (4, 8.0)])
def test_the_time_left_is_that_of_jobs_alike_over_the_workers(write_run, tmp_path, left, expected):
    rows = ROWS[:6] + [("v", "a", "x", fold) for fold in range(4)]
    path = write_run(tmp_path / "run", rows, left=rows[6 : 6 + left], seconds=4.0)
    state = run_state(RunDirectory(path))
    assert sum(seconds_left(state)) / state.workers == expected


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        (("t", "a", "x", 2), 10.0),  # as in the same task
        (("w", "a", "x", 0), 6.0),  # as the same entrant elsewhere
    ],
)
def test_the_most_alike_jobs_count(write_run, tmp_path, row, expected):
    path = tmp_path / "run"
    slow, fast = [("t", "a", "x", 0), ("t", "a", "y", 0)], [("u", "a", "x", 0)]
    write_run(path, slow, seconds=10.0)
    write_run(path, fast, seconds=2.0)
    write_run(path, [*slow, *fast, row], left=[*slow, *fast, row])
    assert seconds_left(run_state(RunDirectory(path))) == [expected]


@pytest.mark.parametrize("done", [(), ("linear",), ("linear", "mohgp-1")])
def test_what_is_left_takes_as_long_as_a_dry_run_says(tmp_path, done):
    """Also where the jobs that are left are of models that the run directory does not know."""
    request = Request("quick", ("toy-interpolation-1",), ("linear", "mohgp"), folds=2)
    planned, store = plan(request, archive_at()), RunDirectory.create(tmp_path / "run")
    for job in planned:
        if job.address.label in done and job.address.fold == 0:
            store.save(job.record(Status.OK, fit_seconds=0.01, predict_seconds=0.01))
    store.save_plan(plan_document(planned, workers=2, provenance={"profile": "quick"}))
    dry = planned, explain(planned, store.path), store.path, "quick"
    state = run_state(store)
    assert state.work_left == expect_work(*dry)[0]
    assert Basis.TYPICAL in {basis for _, basis in state.work_left}
    (line,) = (line for line in forecast_lines(*dry, 2) if line.startswith("time: "))
    assert f"time left: {line.removeprefix('time: ')}" in [*state_lines(state, NOW)]


def test_to_score_what_is_predicted_takes_no_time(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS))
    record = store.planned()[0]
    store.record_path(record.key).unlink()
    state = run_state(store)
    assert (state.total["left"], state.work_left) == (1, [])
    store.fit_path(record.fit_key).unlink()
    assert seconds_left(run_state(store)) == [1.0]


def test_a_model_that_jobs_share_is_fitted_once(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS, left=ROWS[6:], seconds=4.0))
    each = sum(seconds_left(run_state(store)))
    plan = dict(store.load_plan())
    plan["jobs"] = [row | {"training_key": row["task"]} for row in plan["jobs"]]
    store.save_plan(plan)
    assert sum(seconds_left(run_state(store))) == pytest.approx(each / len(ROWS[6:]))


def test_damaged_files_are_named(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS))
    victims = [next(store.path.glob(f"{name}/*/*")) for name in ("records", "predictions")]
    for path in victims:
        path.write_bytes(path.read_bytes()[:-20])
    state = run_state(store)
    assert [any(str(path) in message for message in state.damaged) for path in victims] == [
        True
    ] * 2
    assert state.total["left"] == 1


def test_an_empty_plan_has_no_jobs(write_run, tmp_path):
    assert run_state(RunDirectory(write_run(tmp_path / "run", []))).total.total() == 0


def test_a_run_without_a_plan_is_refused(tmp_path):
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        run_state(RunDirectory.create(tmp_path))


def _lines(store, **about):
    plan = dict(store.load_plan())
    store.save_plan({**plan, "provenance": about})
    return " / ".join(state_lines(run_state(store), NOW))


def test_it_is_said_since_when_and_for_how_long(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS, left=ROWS[:4], seconds=3600.0))
    started = (NOW - timedelta(minutes=5)).isoformat()
    told = _lines(store, started=started)
    assert told.startswith("interrupted, started 2026-01-01 11:55 UTC, 5 min ago")
    assert "time left: about 2.0 h with 2 jobs at once (4.0 h of work in 4 fits)" in told
    assert "the same command resumes it" in told
    finished = RunDirectory(write_run(tmp_path / "all", ROWS))
    assert _lines(finished, started=started, **{"wall time": "12 s"}).endswith("wall time: 12 s")
    assert _lines(finished, **{"merged from": "a; b"}) == "finished, merged from a; b"
    assert re.fullmatch("finished", _lines(finished, started="then and later"))
