"""Commands and options that stand on what a run leaves behind."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from left_behind import leave_lock

from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Status

TOY = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
ROWS = [("t", "a", "x", 0), ("t", "a", "x", 1), ("t", "a", "y", 0)]


def _events(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


@pytest.mark.slow
def test_two_runs_merge_into_one_that_every_command_takes(cli, records, tmp_path):
    one, other, out = tmp_path / "one", tmp_path / "other", tmp_path / "out"
    assert cli(*TOY, "--models", "trivial,cubic-spline", "--out", one) == 0
    assert cli(*TOY, "--models", "cubic-spline,knn", "--out", other) == 0
    assert cli("merge", one, other, "--out", out) == 0
    assert "6 jobs, 6 records, 6 sets of predictions" in cli.printed
    assert cli("report", "--out", out) == 0
    assert "merged from" in (out / "report.html").read_text()
    assert cli("check", out, "--reference", one) == 0
    assert cli("compare", out, other) == 0
    assert cli("compare", out, "--models", "trivial,knn") == 0
    assert cli("export", out) == 0
    assert cli("status", out) == 0
    assert "finished, merged from" in cli.printed
    assert cli(*TOY, "--models", "trivial,cubic-spline,knn", "--explain", "--out", out) == 0
    assert "6 jobs: skip 6" in cli.printed
    assert "6 of 6 jobs are in" in cli.printed
    assert len(records(out)) == 6


def test_a_merge_of_runs_that_contradict_each_other_exits_with_2(cli, write_run, tmp_path):
    one = write_run(tmp_path / "one", ROWS, scores={ROWS[0]: 1.0})
    other = write_run(tmp_path / "other", ROWS, scores={ROWS[0]: 2.0})
    assert cli("merge", one, other, "--out", tmp_path / "out") == 2
    assert "mse 1.0 in" in cli.printed
    assert ", 2.0 in" in cli.printed
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("arguments", [("ONE",), ("ONE", "ABSENT"), ("ONE", "ONE")])
def test_merging_says_what_it_expects(cli, write_run, tmp_path, arguments):
    places = {"ONE": write_run(tmp_path / "one", ROWS), "ABSENT": tmp_path / "absent"}
    code = cli("merge", *map(places.get, arguments), "--out", tmp_path / "out")
    assert code == (0 if arguments == ("ONE", "ONE") else 2)
    assert (tmp_path / "out").exists() is (code == 0)


def test_damaged_files_are_named_by_merge_and_status(cli, write_run, tmp_path):
    one, other = write_run(tmp_path / "one", ROWS[:1]), write_run(tmp_path / "other", ROWS[1:])
    victim = next(one.glob("records/*/*"))
    victim.write_text("{")
    assert cli("merge", one, other, "--out", tmp_path / "out") == 0
    assert f"damaged, so left out: {victim}" in cli.printed
    assert cli("status", one) == 4
    assert f"damaged, so left out: {victim}" in cli.printed


def test_an_empty_merge_ran_nothing(cli, write_run, tmp_path):
    one, other = (write_run(tmp_path / name, []) for name in ("one", "other"))
    assert cli("merge", one, other, "--out", tmp_path / "out") == 4


@pytest.mark.parametrize(
    ("run", "code"),
    [
        ({}, 0),
        ({"left": ROWS[1:]}, 0),
        ({"left": ROWS}, 4),
        ({"statuses": dict.fromkeys(ROWS, Status.DATA_MISSING)}, 4),
        ({"statuses": {ROWS[0]: Status.FAILED}}, 3),
        ({"statuses": {ROWS[0]: Status.TIMEOUT}, "left": ROWS[1:]}, 3),
    ],
)
def test_the_exit_code_of_status_is_that_of_the_run(cli, write_run, tmp_path, run, code):
    write_run(tmp_path / "run", ROWS, **run)
    assert cli("status", tmp_path / "run") == code


def test_status_of_a_run_in_progress_is_fine_and_does_not_disturb_it(cli, write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS, left=ROWS))
    with store.locked():
        assert cli("status", store.path) == 0
        assert "running" in cli.printed


@pytest.mark.parametrize("start", [lambda path: None, RunDirectory.create])
def test_status_of_what_no_run_has_planned_exits_with_2(cli, tmp_path, start):
    start(tmp_path / "run")
    assert cli("status", tmp_path / "run") == 2


def test_the_reasons_are_shown_before_the_run_or_without_it(cli, tmp_path):
    models, out = ("--models", "trivial", "--folds", 1), ("--out", tmp_path / "run")
    assert cli(*TOY, *models, *out, "--explain", "--dry-run") == 0
    assert "1 job: fit and score 1" in cli.printed
    assert not (tmp_path / "run").exists()
    assert cli(*TOY, *models, *out, "--explain") == 0
    assert cli.printed.index("no record yet") < cli.printed.index("1 job: 1 ok")
    files = {p: p.stat().st_mtime_ns for p in (tmp_path / "run").rglob("*")}
    assert cli(*TOY, *models, *out, "--explain", "--dry-run", "--seed", 1) == 0
    assert "seed 0 → 1" in cli.printed
    assert files == {p: p.stat().st_mtime_ns for p in (tmp_path / "run").rglob("*")}


def test_the_log_tells_a_run_from_start_to_end(cli, tmp_path):
    path = tmp_path / "run" / "log.jsonl"
    chosen = (*TOY, "--models", "trivial,cubic-spline", "--out", tmp_path / "run")
    assert cli(*chosen, "--folds", 1, "--log-json", path) == 0
    first, *between, last = _events(path)
    assert (first["event"], first["jobs"], first["in_store"]) == ("run-started", 2, 0)
    assert (last["event"], last["counts"], last["exit_code"]) == ("run-ended", {"ok": 2}, 0)
    for label in ("trivial", "cubic-spline"):
        started, ended = (event for event in between if event["label"] == label)
        assert (started["event"], ended["event"]) == ("job-started", "job-ended")
        assert (ended["status"], ended["fold"], ended["seconds"] > 0) == ("ok", 0, True)
    assert cli(*chosen, "--folds", 2, "--log-json", path) == 0
    again = _events(path)[4 + 2 :]
    assert (again[0]["jobs"], again[0]["in_store"]) == (4, 2)
    assert again[-1]["counts"] == {"ok": 2}


def test_the_log_tells_failures_and_missing_data(cli, tmp_path, broken_models, monkeypatch):
    path, out = tmp_path / "log.jsonl", ("--out", tmp_path / "run")
    failing = ("--models", "raises", "--plugin", broken_models, "--folds", 1)
    assert cli(*TOY, *failing, *out, "--log-json", path) == 3
    (ended,) = (event for event in _events(path) if event["event"] == "job-ended")
    assert (ended["status"], "raised" in ended["message"]) == ("failed", True)
    assert _events(path)[-1]["exit_code"] == 3
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    lacking = ("--tasks", "missing-frames", "--cases", "35-03*", "--models", "cubic-spline")
    assert cli("run", "--offline", *lacking, "--folds", 1, *out, "--log-json", path) == 4
    *_, ended, last = _events(path)
    assert (ended["status"], ended["seconds"]) == ("data-missing", 0)
    assert "mocapbench data fetch" in ended["message"]
    assert last["counts"].keys() == {"data-missing"}


def test_a_log_that_cannot_be_written_is_refused_before_anything_runs(cli, tmp_path):
    chosen = (*TOY, "--models", "trivial", "--out", tmp_path / "run")
    assert cli(*chosen, "--log-json", tmp_path / "no" / "log") == 2
    assert "expected a file in a folder that exists" in cli.printed
    assert not (tmp_path / "run").exists()


def test_the_log_of_a_refused_run_tells_its_end(cli, tmp_path):
    store, path = RunDirectory.create(tmp_path / "run"), tmp_path / "log.jsonl"
    with store.locked():
        assert cli(*TOY, "--out", store.path, "--log-json", path) == 2
    (ended,) = _events(path)
    assert (ended["event"], ended["exit_code"]) == ("run-ended", 2)


def test_a_run_sweeps_what_a_killed_one_left(cli, tmp_path):
    RunDirectory.create(tmp_path / "run")
    for name in (".mocapbench-tmp-abcdef12", "records/ab/.mocapbench-tmp-abcdef12"):
        leave_lock(tmp_path / "run" / name)
        (tmp_path / "run" / name).write_text("half")
    assert cli(*TOY, "--models", "trivial", "--folds", 1, "--out", tmp_path / "run") == 0
    assert [*(tmp_path / "run").rglob(".mocapbench-tmp-*")] == []


@pytest.mark.slow
def test_an_interrupted_run_is_logged_seen_and_finished(cli, tmp_path):
    out, log = tmp_path / "run", tmp_path / "log.jsonl"
    chosen = [*TOY, "--models", "trivial,cubic-spline", "--folds", "12", "--out", str(out)]
    script = "from mocapbench.benchmark.cli.main import main; main()"
    process = subprocess.Popen(
        [sys.executable, "-c", script, *chosen, "--jobs", "1", "--log-json", str(log)],
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        while len(list(out.glob("records/*/*.json"))) < 3:
            assert process.poll() is None
            time.sleep(0.01)
        assert cli("status", out) == 0
        assert "running, started" in cli.printed
    finally:
        os.killpg(process.pid, signal.SIGINT)
        process.wait(timeout=60)
    assert _events(log)[-1]["exit_code"] == 130
    assert cli("status", out) == 0
    assert "interrupted, started" in cli.printed
    assert cli(*chosen) == 0
    assert cli("status", out) == 0
    assert "finished, started" in cli.printed


def test_a_surrogate_in_an_exception_can_be_stored_exported_and_shown(cli, records, tmp_path):
    plugin = tmp_path / "plugin.py"
    plugin.write_text(
        "from mocapbench.baselines import Imputer\n"
        "class Broken(Imputer):\n"
        "    def fit(self, recordings): raise RuntimeError('\\udc80')\n"
        "    def impute(self, recordings): raise RuntimeError\n"
        "MODELS = {'broken': Broken}\n"
    )
    options = ("--models", "broken", "--plugin", plugin, "--out", tmp_path / "run")
    assert cli(*TOY, *options) == 3
    assert {record["message"] for record in records(tmp_path / "run").values()} == {
        r"RuntimeError: \udc80"
    }
    assert cli("export", tmp_path / "run", "--to", tmp_path / "tables") == 0
