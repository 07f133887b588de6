import importlib
import json
import os
import re
import subprocess
import sys
import time

import pandas as pd
import pytest
from plans import plan_of
from typer.main import get_command

import mocapbench
from mocapbench.basics.words import join_names
from mocapbench.benchmark import gate
from mocapbench.benchmark.cli.commands import COMMANDS
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES, METRICS, MODELS, REGISTRIES, TASKS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

TOY = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
FAST = (*TOY, "--models", "trivial,cubic-spline")


def _scores(records):
    return {address: record["scores"] for address, record in records.items()}


def test_a_run_ends_in_a_report(cli, records, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert str(tmp_path / "run" / "report.html") in cli.printed.replace(" ", "")
    assert (
        (tmp_path / "run" / "report.html")
        .read_text()
        .lower()
        .lstrip()
        .startswith("<!doctype html>")
    )
    found = records(tmp_path / "run")
    assert {(label, fold) for _, _, label, fold in found} == {
        (label, fold) for label in ("trivial", "cubic-spline") for fold in (0, 1)
    }
    assert all(record["scores"]["mse"] > 0 for record in found.values())
    assert all(
        "msll" not in r["scores"] for (_, _, label, _), r in found.items() if label != "trivial"
    )


@pytest.mark.slow
def test_scores_do_not_depend_on_workers_or_on_which_models_run(cli, records, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "one", "--jobs", 1) == 0
    assert cli(*FAST, "--out", tmp_path / "two", "--jobs", 2) == 0
    assert cli(*TOY, "--models", "trivial", "--out", tmp_path / "alone") == 0
    one, two, alone = (_scores(records(tmp_path / name)) for name in ("one", "two", "alone"))
    assert one == two
    assert alone == {address: one[address] for address in alone}


@pytest.mark.slow
def test_threads_change_no_score_and_the_engine_is_on_record(cli, records, tmp_path):
    chosen = (*TOY, "--models", "mohgp-3", "--jobs", 1, "--folds", 1)
    assert cli(*chosen, "--out", tmp_path / "one") == 0
    assert cli(*chosen, "--out", tmp_path / "two", "--threads", 2) == 0
    one, two = (records(tmp_path / name) for name in ("one", "two"))
    for address, record in one.items():
        assert two[address]["scores"] == pytest.approx(record["scores"], rel=1e-8)
        assert "billion operations" in two[address]["engine"]
        assert (record["provenance"]["threads"], two[address]["provenance"]["threads"]) == (
            "1 per job",
            "2 per job",
        )


@pytest.mark.slow
def test_scores_do_not_depend_on_the_order_of_registration(cli, records, tmp_path, broken_models):
    """The same models from a file, in either order, seeds and fits included."""
    source = (
        "from mocapbench.baselines.mohgp import MOHGP\nfrom mocapbench.baselines.moa import MOA\n"
    )
    pairs = ["'my-a': MOHGP", "'my-b': MOA"]
    found = []
    for name, order in (("forth", pairs), ("back", pairs[::-1])):
        path = tmp_path / f"{name}.py"
        path.write_text(f"{source}MODELS = {{{', '.join(order)}}}\n")
        out = tmp_path / name
        arguments = ("--models", "my-a,my-b", "--folds", 1, "--plugin", path, "--out", out)
        assert cli(*TOY, *arguments) == 0
        found.append(_scores(records(out)))
    assert found[0] == found[1]
    assert len(found[0]) == 2


def test_a_second_run_computes_nothing(cli, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "run/records").glob("*/*")}
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert "4 of 4 jobs are in" in cli.printed
    assert before == {
        path: path.stat().st_mtime_ns for path in (tmp_path / "run/records").glob("*/*")
    }


def test_a_smaller_run_says_what_its_report_leaves_out(cli, tmp_path):
    wide = (*TOY, "--models", "linear,knn,nn", "--folds", 2, "--out", tmp_path / "run")
    assert cli(*wide) == 0
    assert "not in the report" not in cli.printed
    assert cli(*TOY, "--models", "linear", "--folds", 2, "--out", tmp_path / "run") == 0
    assert "not in the report: 4 results of the run before (models knn, nn)" in cli.printed
    assert cli(*wide) == 0
    assert "not in the report" not in cli.printed
    assert cli(*wide, "--folds", 1) == 0
    assert "3 results of the run before (3 others)" in cli.printed


@pytest.mark.slow
def test_the_wall_time_of_a_resumed_run_says_what_it_leaves_out(cli, tmp_path):
    run = (*TOY, "--models", "linear", "--out", tmp_path / "run", "--folds")
    assert cli(*run, 1) == 0
    about = RunDirectory(tmp_path / "run").load_plan()["provenance"]
    assert re.fullmatch(r"\d+ s", about["wall time"])
    time.sleep(1.0)  # the time of the start, which has no fractions, is another
    assert cli(*run, 3) == 0
    about = RunDirectory(tmp_path / "run").load_plan()["provenance"]
    assert re.fullmatch(r"\d+ s; 1 result is of an earlier run", about["wall time"])


def _take_longer(path):
    """Change a record as a job that ran again would, whose scores are the same."""
    record = json.loads(path.read_text())
    path.write_text(json.dumps(record | {"fit_seconds": record["fit_seconds"] + 1}))


LONG_AGO = (1.0, 1.0)


@pytest.mark.slow
def test_a_finished_run_is_drawn_again_only_if_something_is_new(cli, tmp_path):
    run, page = (*FAST, "--out", tmp_path / "run"), tmp_path / "run" / "report.html"
    assert cli(*run) == 0
    assert cli("check", tmp_path / "run", "--reference", tmp_path / "run") == 0
    os.utime(page, LONG_AGO)
    assert cli(*run) == 0
    assert "nothing new; report:" in cli.printed
    assert page.stat().st_mtime == LONG_AGO[0]
    assert RunDirectory(tmp_path / "run").load_check()  # what was checked is still the last run
    news = [
        page.unlink,
        lambda: page.write_text("changed by somebody"),
        lambda: _take_longer(next((tmp_path / "run").glob("records/*/*"))),
        lambda: cli(*run, "--folds", 1),
    ]
    for happens in news:
        happens()
        assert cli(*run) == 0
        assert "nothing new" not in cli.printed
        assert page.stat().st_mtime > LONG_AGO[0]
        os.utime(page, LONG_AGO)


def test_a_run_without_a_report_leaves_it_to_a_later_one(cli, tmp_path):
    run, page = (*FAST, "--out", tmp_path / "run"), tmp_path / "run" / "report.html"
    assert cli(*run, "--no-report") == 0
    assert not page.exists()
    assert "`mocapbench report --out" in cli.printed
    assert cli(*run) == 0
    assert page.exists()
    os.utime(page, LONG_AGO)
    assert cli(*run, "--no-report") == 0
    assert "nothing new; report:" in cli.printed
    assert cli(*run) == 0
    assert page.stat().st_mtime == LONG_AGO[0]
    assert cli(*run, "--folds", 1, "--no-report") == 0
    renewed = re.escape(f"report.html shows an earlier run; `mocapbench report --out {run[-1]}`")
    assert re.search(f"{renewed} renews it", cli.printed)
    assert page.stat().st_mtime == LONG_AGO[0]
    assert cli(*run) == 0
    assert page.stat().st_mtime > LONG_AGO[0]


def test_new_metrics_are_scored_without_refitting(cli, tmp_path):
    assert cli(*FAST, "--metrics", "mse", "--out", tmp_path / "run") == 0
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "run/predictions").glob("*/*")}
    assert cli(*FAST, "--metrics", "mse,smse", "--out", tmp_path / "run") == 0
    after = {path: path.stat().st_mtime_ns for path in (tmp_path / "run/predictions").glob("*/*")}
    assert before == after
    rescored = [p for p in (tmp_path / "run/records").glob("*/*") if '"smse"' in p.read_text()]
    assert len(rescored) == 4


def test_centimetres_are_scored_from_stored_predictions(cli, tmp_path):
    out = tmp_path / "run"
    which = ("run", "--tasks", "missing-frames", "--profile", "smoke", "--models", "knn")
    which = (*which, "--offline", "--out", out)
    assert cli(*which, "--metrics", "rms_per_frame") == 0
    before = {path: path.stat().st_mtime_ns for path in (out / "predictions").glob("*/*")}
    assert before
    assert cli(*which, "--metrics", "mpjpe") == 0
    assert {p: p.stat().st_mtime_ns for p in (out / "predictions").glob("*/*")} == before
    (record,) = RunDirectory(out).planned()  # of the last run
    assert 0.0 < record.scores["mpjpe"] < 100.0
    assert len(record.parts["mpjpe"]["joint"]) == 31


def test_a_damaged_record_is_reported_and_computed_again(cli, records, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    whole = _scores(records(tmp_path / "run"))
    victim = next((tmp_path / "run" / "records").glob("*/*"))
    victim.write_text(victim.read_text()[:100])
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert f"damaged, so left out: {victim}" in cli.printed
    assert _scores(records(tmp_path / "run")) == whole


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("--tasks", "toy-interpolaton-1"), "did you mean toy-interpolation-1"),
        (("--models", "cubic-splin"), "did you mean cubic-spline"),
        (("--metrics", "msl"), "did you mean msll"),
        (("--profile", "quik"), "did you mean quick"),
        (("--tasks", "toy-interpolation-1", "--cases", "test 11"), "did you mean test 1"),
        (("--tasks", "missing-frames", "--models", "mohgp"), "nothing to run"),
        (("--plugin", "absent.py"), "expected a Python file"),
        (("--model-file", "absent.py"), "expected a Python file"),
        (("--data-dir", "absent"), "absent"),
        (("--folds", "0"), "folds"),
        (("--tasks", "toy-interpolation-1", "--metrics", "mccc"), "did you mean mcc"),
        (("--tasks", "missing-frames", "--folds", "13"), "has 12 folds, got 13"),
    ],
)
def test_bad_requests_exit_with_2_and_write_nothing(cli, tmp_path, arguments, complaint):
    assert cli("run", "--offline", *arguments, "--out", tmp_path / "run") == 2
    assert complaint in cli.printed
    assert not (tmp_path / "run").exists()


def test_a_folder_that_is_not_ours_is_left_alone(cli, tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    assert cli(*FAST, "--out", tmp_path) == 2
    assert "name a new or empty folder" in cli.printed
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_missing_recordings_are_not_a_failure(cli, records, tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    arguments = (
        "--tasks",
        "missing-frames",
        "--cases",
        "35-03*,synthetic*",
        "--models",
        "cubic-spline",
    )
    assert cli("run", "--offline", *arguments, "--folds", 1, "--out", tmp_path / "run") == 0
    found = {case: record for (_, case, _, _), record in records(tmp_path / "run").items()}
    assert found["35-03 three-walkers"]["status"] == "data-missing"
    said = "not on this machine: 35_03, 35_02, 12_01, 16_15; get them with `mocapbench data fetch "
    assert found["35-03 three-walkers"]["message"].startswith(said)
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "Not on this machine: 35_03, 35_02, 10_04, 12_01, 16_15. 2 jobs of" in page
    assert ">mocapbench data fetch 35_03 35_02 10_04 12_01 16_15<" in page
    assert any(r["status"] == "ok" for case, r in found.items() if case.startswith("synthetic"))


def test_a_run_without_any_recording_ran_nothing(cli, tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    arguments = ("--tasks", "missing-frames", "--cases", "35-03*", "--models", "cubic-spline")
    assert cli("run", "--offline", *arguments, "--folds", 1, "--out", tmp_path / "run") == 4


def test_a_dry_run_writes_nothing(cli, tmp_path):
    assert cli(*FAST, "--dry-run", "--out", tmp_path / "run") == 0
    assert "4 jobs" in cli.printed
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("kind", "registry"),
    [*zip(["models", "tasks", "metrics", "libraries", "formats"], REGISTRIES, strict=True)],
)
def test_list_names_everything(cli, kind, registry):
    assert cli("list", kind) == 0
    assert registry.names()
    assert all(name in cli.printed for name in registry.names())


@pytest.mark.parametrize("kind", ["models", "tasks", "metrics", "libraries"])
def test_a_list_fits_a_terminal_of_80_columns(capsys, monkeypatch, kind):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit):
        main(["list", kind])
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert not any("…" in line for line in lines)


@pytest.mark.parametrize(
    ("kind", "registry", "keys"),
    [
        ("models", MODELS, {"summary", "abilities", "parameters"}),
        ("tasks", TASKS, {"title", "cases", "profiles", "entrants", "recordings"}),
        ("metrics", METRICS, {"title", "better", "of"}),
        ("libraries", LIBRARIES, {"summary", "layout"}),
    ],
)
def test_a_list_can_be_had_as_json(capsys, kind, registry, keys):
    with pytest.raises(SystemExit):
        main(["list", kind, "--json"])
    entries = json.loads(capsys.readouterr().out)
    assert [entry["name"] for entry in entries] == list(registry.names())
    assert all(keys <= entry.keys() for entry in entries)
    assert all(entry.get("title") or entry.get("summary") for entry in entries)


def test_a_named_task_is_shown_with_its_cases_folds_and_entrants(cli):
    assert cli("list", "tasks", "toy-synthesis") == 0
    task = TASKS.get("toy-synthesis")
    assert all(case.name in cli.printed for case in task.cases)
    assert all(entrant.label in cli.printed for entrant in task.entrants)
    assert "smoke: 1 case × 2 folds" in cli.printed
    assert "missing-frames" not in cli.printed
    assert cli("list", "tasks", "toy-synthesi") == 2
    assert "did you mean toy-synthesis" in cli.printed


def test_info_says_how_to_cite(cli):
    assert cli("info") == 0
    assert "@software{mocapbench" in cli.printed
    assert "numpy version" in cli.printed


def test_export_holds_one_row_per_score(cli, records, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert cli("export", tmp_path / "run", "--to", tmp_path / "tables") == 0
    table = pd.read_parquet(tmp_path / "tables" / "scores.parquet")
    found = records(tmp_path / "run").values()
    assert len(table) == sum(len(record["scores"]) for record in found)
    missing = {"keep_default_na": False, "na_values": {"sample_two_sd": [""]}}
    text = pd.read_csv(tmp_path / "tables" / "scores.csv", **missing)
    pd.testing.assert_frame_equal(table, text, check_dtype=False)


@pytest.mark.slow
@pytest.mark.parametrize("edits", [1, 3])
def test_an_export_holds_the_last_run_alone(cli, tmp_path, edits):
    """As the other commands do: after a plug-in was edited, each fold and label has one row."""
    plugin, run = tmp_path / "mine.py", tmp_path / "run"
    chosen = ("--tasks", "toy-interpolation-1", "--cases", "test 1", "--folds", 2, "--offline")
    for size in range(edits + 1):
        plugin.write_text(
            "from mocapbench.baselines import LinearImputer, Prediction\n\n\n"
            "class Mine(LinearImputer):\n"
            '    """Mine."""\n\n'
            "    def impute(self, recordings):\n"
            "        answers = super().impute(recordings)\n"
            f"        return [Prediction(a.mean + {size}) for a in answers]\n\n\n"
            'MODELS = {"mine": Mine}\n'
        )
        assert cli("run", *chosen, "--plugin", plugin, "--models", "mine", "--out", run) == 0
    assert cli("export", run, "--to", tmp_path / "tables") == 0
    assert f"not exported: {2 * edits} jobs of earlier runs" in cli.printed
    scores, jobs = (pd.read_csv(tmp_path / "tables" / f"{name}.csv") for name in ("scores", "jobs"))
    assert not scores.duplicated(["task", "case", "fold", "label", "metric"]).any()
    assert len(jobs) == 2
    kept = {record.key: record.scores["mse"] for record in RunDirectory(run).planned()}
    own = scores[scores["metric"] == "mse"].set_index("key")["value"]
    assert own.to_dict() == pytest.approx(kept)


def test_no_text_of_an_export_begins_a_formula(cli, tmp_path):
    store = RunDirectory.create(tmp_path / "run")
    message, address = "-it\rbroke", Address("toy-interpolation-1", 1, "test 1", 0, "=1+1")
    fields = {"message": message, "scores": {"mse": -1.5}, "iterations": 3}
    store.save(Record("a", "a", address, 0, "@knn", {}, Status.FAILED, **fields))
    store.save(Record("b", "b", address._replace(fold=1), 0, "@knn", {}, Status.OK))
    store.save_plan(plan_of(store.records()))
    assert cli("export", tmp_path / "run", "--to", tmp_path) == 0
    jobs, scores = (pd.read_csv(tmp_path / f"{name}.csv") for name in ("jobs", "scores"))
    assert set(jobs["label"]) == {"'=1+1"}
    assert set(jobs["model"]) == {"'@knn"}
    assert jobs["message"].dropna().to_list() == ["'-it\nbroke"]
    assert jobs["iterations"].dropna().to_list() == [3]
    assert scores["value"].to_list() == [-1.5]
    kept = pd.read_parquet(tmp_path / "jobs.parquet")
    assert set(kept["label"]) == {"=1+1"}
    assert "-it\nbroke" in set(kept["message"])


@pytest.mark.parametrize("command", [("report", "--out"), ("export",), ("figures",)])
def test_commands_on_a_folder_that_is_no_run_exit_with_2(cli, tmp_path, command):
    assert cli(*command, tmp_path) == 2
    assert "is not a mocapbench run" in cli.printed


def test_a_report_can_be_written_elsewhere(cli, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert cli("report", "--out", tmp_path / "run", "--to", tmp_path / "page.html") == 0
    assert (tmp_path / "page.html").read_text() == (tmp_path / "run" / "report.html").read_text()


def test_a_report_into_a_folder_that_is_not_there_exits_with_2(cli, tmp_path):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    assert cli("report", "--out", tmp_path / "run", "--to", tmp_path / "no" / "page.html") == 2
    assert "page.html: expected a file in a folder that exists" in cli.printed


UNWRITABLE = {
    "check": ("check", "RUN", "--junit", "FILE", "--reference", "RUN"),
    "compare": ("compare", "RUN", "RUN", "--csv", "FILE"),
    "power": ("power", "RUN", "--csv", "FILE"),
    "report": ("report", "--out", "RUN", "--to", "FILE"),
}


@pytest.mark.parametrize("command", UNWRITABLE.values(), ids=UNWRITABLE)
@pytest.mark.parametrize("file", ["no/file", "."])
def test_a_file_that_cannot_be_written_is_refused_before_anything_is_read(
    cli, tmp_path, command, file
):
    places = {"RUN": tmp_path / "absent", "FILE": tmp_path / file}
    assert cli(*(places.get(word, word) for word in command)) == 2
    assert "expected a file in a folder that exists" in cli.printed


def test_a_defect_is_told_from_a_worse_metric(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(gate, "read_reference", lambda path: 1 / 0)
    RunDirectory.create(tmp_path).save_plan(plan_of([]))
    with pytest.raises(SystemExit) as ended:
        main(["check", str(tmp_path), "--reference", "b.csv"])
    assert ended.value.code == 70
    printed = capsys.readouterr().err
    assert "ZeroDivisionError" in printed
    assert "a defect of mocapbench or an added package" in printed


def test_the_version_is_shown(cli):
    assert cli("--version") == 0
    assert cli.printed == f"mocapbench {mocapbench.__version__}"


@pytest.mark.parametrize("name", COMMANDS)
def test_the_list_of_commands_says_of_each_what_it_says_itself(cli, name):
    module = importlib.import_module(f"mocapbench.benchmark.cli.{name.replace('-', '_')}")
    command = get_command(module.app)
    assert COMMANDS[name] == command.help.partition("\n")[0]
    assert cli("--help") == 0
    assert COMMANDS[name] in cli.printed
    assert cli(name, "--help") == 0
    assert COMMANDS[name] in cli.printed


@pytest.mark.parametrize(("wrong", "meant"), [("rnu", "run"), ("compar", "compare")])
def test_an_unknown_command_exits_with_2_and_names_the_nearest(cli, wrong, meant):
    assert cli(wrong) == 2
    assert cli.printed == f"error: unknown command {wrong!r}: did you mean {meant}?"


def test_a_command_like_no_other_exits_with_2_and_lists_them(cli):
    assert cli("@@@@") == 2
    assert cli.printed == f"error: unknown command '@@@@': known: {join_names(COMMANDS, 20)}"


def test_a_run_that_another_one_writes_to_is_refused(cli, tmp_path):
    store = RunDirectory.create(tmp_path / "run")
    with store.locked():
        assert cli(*FAST, "--out", tmp_path / "run") == 2
        assert "another run is writing to" in cli.printed
        assert "wait for it or name another folder" in cli.printed
        assert [*(tmp_path / "run" / "records").rglob("*.json")] == []
    assert cli(*FAST, "--models", "trivial", "--folds", 1, "--out", tmp_path / "run") == 0


@pytest.mark.slow
def test_the_lock_does_not_outlive_a_killed_process(tmp_path):
    store = RunDirectory.create(tmp_path)
    script = (
        "import sys, time\n"
        "from pathlib import Path\n"
        "from mocapbench.benchmark.runs.directory import RunDirectory\n"
        "with RunDirectory(Path(sys.argv[1])).locked():\n"
        "    print('locked', flush=True)\n"
        "    time.sleep(600)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout.readline() == "locked\n"
        with pytest.raises(UsageError, match="another run is writing"), store.locked():
            pass
    finally:
        process.kill()
        process.communicate(timeout=60)
    with store.locked():
        pass


def test_if_one_table_cannot_be_written_those_of_an_earlier_run_stay(cli, tmp_path, monkeypatch):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    tables = tmp_path / "tables"
    tables.mkdir()
    for name in ("scores", "jobs"):
        (tables / f"{name}.csv").write_text("earlier")
    module = importlib.import_module("mocapbench.benchmark.cli.export")
    write = module._write_csv

    def fail(table, path):
        if path.name == "jobs.csv":
            raise OSError(28, "No space left on device")
        write(table, path)

    monkeypatch.setattr(module, "_write_csv", fail)
    assert cli("export", tmp_path / "run", "--to", tables) == 2
    assert "No space left on device" in cli.printed
    assert {path.name: path.read_text() for path in tables.iterdir()} == {
        "scores.csv": "earlier",
        "jobs.csv": "earlier",
    }


def test_export_without_pyarrow_writes_csv_and_says_how_to_get_parquet(cli, tmp_path, monkeypatch):
    assert cli(*FAST, "--out", tmp_path / "run") == 0
    module = importlib.import_module("mocapbench.benchmark.cli.export")
    monkeypatch.setattr(module, "find_spec", {}.get)
    assert cli("export", tmp_path / "run", "--to", tmp_path / "tables") == 0
    assert "pip install 'mocapbench[parquet]'" in cli.printed
    assert "no Parquet files, which need pyarrow" in cli.printed
    assert {path.name for path in (tmp_path / "tables").iterdir()} == {"scores.csv", "jobs.csv"}
    assert len(pd.read_csv(tmp_path / "tables" / "jobs.csv")) == 4
    assert "scores.csv" in cli.printed
    assert ".parquet" not in cli.printed
