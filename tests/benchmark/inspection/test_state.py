"""The state of a run is what its plan and its records say, whoever asks, and when."""

import re
from datetime import UTC, datetime, timedelta

import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.inspection.output import state_lines
from mocapbench.benchmark.inspection.state import UNKNOWN, run_state
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.store import Store

ROWS = [(task, "a", label, fold) for task in "tu" for label in "xy" for fold in (0, 1, 2)]
NOW = datetime(2026, 1, 1, 12, tzinfo=UTC)


def test_jobs_are_counted_by_task(write_run, tmp_path):
    statuses = {
        ROWS[0]: Status.FAILED,
        ROWS[1]: Status.TIMEOUT,
        ROWS[2]: Status.OUT_OF_MEMORY,
        ROWS[3]: Status.DATA_MISSING,
    }
    store = Store(write_run(tmp_path / "run", ROWS, statuses=statuses, left=ROWS[6:8]))
    state = run_state(store)
    assert list(state.tasks) == ["t", "u"]
    assert state.tasks["t"] == (2, 3, 1, 0)
    assert state.tasks["u"] == (4, 0, 0, 2)
    assert state.total == (6, 3, 1, 2)
    assert state.total.planned == len(ROWS)


def test_a_run_is_running_interrupted_or_finished(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS, left=ROWS[:2]))
    with store.locked():
        assert run_state(Store(store.path)).name == "running"
    assert run_state(store).name == "interrupted"
    assert run_state(Store(write_run(tmp_path / "all", ROWS))).name == "finished"


@pytest.mark.parametrize(("left", "expected"), [(0, 0.0), (1, 2.0), (4, 8.0)])
def test_the_time_left_is_that_of_jobs_alike_over_the_workers(write_run, tmp_path, left, expected):
    rows = ROWS[:6] + [("v", "a", "x", fold) for fold in range(4)]
    path = write_run(tmp_path / "run", rows, left=rows[6 : 6 + left], seconds=4.0)
    assert run_state(Store(path)).seconds_left == expected


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        (("t", "a", "x", 2), 10.0),  # as in the same task
        (("w", "a", "x", 0), 6.0),  # as the same entrant elsewhere
        (("w", "a", "z", 0), 22.0 / 3),  # as any job
    ],
)
def test_the_most_alike_jobs_count(write_run, tmp_path, row, expected):
    path = tmp_path / "run"
    slow, fast = [("t", "a", "x", 0), ("t", "a", "y", 0)], [("u", "a", "x", 0)]
    write_run(path, slow, seconds=10.0)
    write_run(path, fast, seconds=2.0)
    write_run(path, [*slow, *fast, row], left=[*slow, *fast, row])
    assert run_state(Store(path)).seconds_left == pytest.approx(expected / 2)


def test_to_score_what_is_predicted_takes_no_time(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS))
    record = store.planned()[0]
    store.record_path(record.key).unlink()
    state = run_state(store)
    assert (state.total.left, state.seconds_left) == (1, 0.0)
    store.fit_path(record.fit_key).unlink()
    assert run_state(store).seconds_left == 0.5


def test_a_model_that_jobs_share_is_fitted_once(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS, left=ROWS[6:], seconds=4.0))
    each = run_state(store).seconds_left
    plan = dict(store.load_plan())
    plan["jobs"] = [row | {"training_key": row["task"]} for row in plan["jobs"]]
    store.save_plan(plan)
    assert run_state(store).seconds_left == pytest.approx(each / len(ROWS[6:]))


def test_damaged_files_are_named(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS))
    victims = [next(store.path.glob(f"{name}/*/*")) for name in ("records", "predictions")]
    for path in victims:
        path.write_bytes(path.read_bytes()[:-20])
    state = run_state(store)
    assert [any(str(path) in message for message in state.damaged) for path in victims] == [
        True
    ] * 2
    assert state.total.left == 1


def test_of_plans_of_earlier_versions_only_records_tell_the_task(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS, left=ROWS[-2:]))
    store.save_plan({name: store.load_plan()[name] for name in ("keys", "provenance")})
    assert run_state(store).tasks == {"t": (6, 0, 0, 0), "u": (4, 0, 0, 0), UNKNOWN: (0, 0, 0, 2)}


def test_an_empty_plan_has_no_jobs(write_run, tmp_path):
    assert run_state(Store(write_run(tmp_path / "run", []))).total.planned == 0


def test_a_run_without_a_plan_is_refused(tmp_path):
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        run_state(Store.create(tmp_path))


def _lines(store, **about):
    plan = dict(store.load_plan())
    store.save_plan({**plan, "provenance": about})
    return " / ".join(state_lines(run_state(store), NOW))


def test_it_is_said_since_when_and_for_how_long(write_run, tmp_path):
    store = Store(write_run(tmp_path / "run", ROWS, left=ROWS[:4], seconds=3600.0))
    started = (NOW - timedelta(minutes=5)).isoformat()
    told = _lines(store, started=started)
    assert told.startswith("interrupted, started 2026-01-01 11:55 UTC, 5 min ago")
    assert "about 2.0 h of work left" in told
    assert "the same command resumes it" in told
    finished = Store(write_run(tmp_path / "all", ROWS))
    assert _lines(finished, started=started, **{"wall time": "12 s"}).endswith("wall time: 12 s")
    assert _lines(finished, **{"merged from": "a; b"}) == "finished, merged from a; b"
    assert re.fullmatch("finished", _lines(finished, started="then and later"))
