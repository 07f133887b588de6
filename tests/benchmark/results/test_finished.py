"""A finished run is told from its own files, unless anything that it depends on is new."""

import json
import shutil

import pytest

from mocapbench import benchmark as bench
from mocapbench import datasets
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.results import finished

ASKED = ["smoke", ["missing-frames"], ["trivial"], [], [], 2, 0]
COMMAND = ("--profile", "smoke", "--tasks", "missing-frames", "--models", "trivial", "--folds", "2")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The directory of a run that has finished, on generated recordings."""
    folder = tmp_path_factory.mktemp("made") / "run"
    with pytest.raises(SystemExit) as ended:
        main(["run", *COMMAND, "--out", str(folder)])
    assert ended.value.code == 0
    return folder


@pytest.fixture
def run(made, tmp_path):
    """A copy of it, which a test may change."""
    return bench.RunDirectory(shutil.copytree(made, tmp_path / "run"))


def _is_finished(run, asked=ASKED):
    archive = bench.archive_at()
    return bool(finished.finished_records(bench.RunDirectory(run.path), asked, archive))


def test_its_records_come_in_the_order_of_the_tables(run):
    records = finished.finished_records(run, ASKED, bench.archive_at())
    assert [record.key for record in records] == run.load_plan()["keys"]
    assert [r.to_json() for r in records] == [r.to_json() for r in run.planned()]


@pytest.mark.parametrize("place", range(len(ASKED)))
def test_another_request_is_not_finished(run, place):
    other = ["quick", [], [], ["25"], ["mse"], 1, 7][place]
    assert not _is_finished(run, [*ASKED[:place], other, *ASKED[place + 1 :]])


def _change_code(run, monkeypatch):
    monkeypatch.setattr(finished, "digest_code", lambda: "of another version")


def _change_library(run, monkeypatch):
    monkeypatch.setattr(finished.importlib.metadata, "version", lambda name: "0.1")


def _change_recording(run, monkeypatch):
    monkeypatch.setattr(datasets.Archive, "digest", lambda archive, uri: "of another file")


def _lose_recording(run, monkeypatch):
    monkeypatch.setattr(datasets.Archive, "available", lambda archive, uri: False)


def _lose_library(run, monkeypatch):
    plan = {**run.load_plan(), "recordings": ["gone:01_01"]}
    (run.path / "plan.json").write_text(json.dumps(plan))


def _lose_record(run, monkeypatch):
    run.record_path(run.load_plan()["keys"][0]).unlink()


def _break_record(run, monkeypatch):
    path = run.record_path(run.load_plan()["keys"][0])
    path.write_text(path.read_text().replace('"ok"', '"failed"'))


def _change_record(run, monkeypatch):
    path = run.record_path(run.load_plan()["keys"][0])
    path.write_text(path.read_text().replace('"message":""', '"message":"changed"'))
    assert "changed" in path.read_text()


def _lose_report(run, monkeypatch):
    (run.path / "report.html").unlink()


def _change_report(run, monkeypatch):
    (run.path / "report.html").write_text("")


def _lose_plan(run, monkeypatch):
    (run.path / "plan.json").unlink()


def _add_model(run, monkeypatch):
    monkeypatch.setitem(MODELS._added, "another-laboratorys", object)


@pytest.mark.parametrize(
    "change",
    [
        _change_code,
        _change_library,
        _change_recording,
        _lose_recording,
        _lose_library,
        _lose_record,
        _break_record,
        _change_record,
        _lose_report,
        _change_report,
        _lose_plan,
        _add_model,
    ],
)
def test_what_depends_on_something_new_is_not_finished(run, change, monkeypatch):
    assert _is_finished(run)
    change(run, monkeypatch)
    assert not _is_finished(run)


def test_with_code_of_others_no_run_says_from_what_it_follows(monkeypatch):
    assert finished.describe_basis(ASKED, {})
    monkeypatch.setitem(MODELS._added, "another-laboratorys", object)
    assert finished.describe_basis(ASKED, {}) == {}
