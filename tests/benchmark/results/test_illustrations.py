import pytest

from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.figures.illustrations import illustrations
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.store import Store
from mocapbench.datasets import RecordingUnavailable, open_archive

RUN = ("run", "--profile", "smoke", "--tasks", "upper-body-missing", "--offline")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Return the run directory of two models that fill upper bodies."""
    out = tmp_path_factory.mktemp("run")
    with pytest.raises(SystemExit) as ended:
        main([*RUN, "--models", "nn,trivial", "--out", str(out / "run")])
    assert ended.value.code == 0
    return out / "run"


@pytest.fixture
def store(finished):
    return Store.open(finished)


def test_a_report_shows_what_was_filled(finished, store):
    (illustration,) = illustrations(store.records(), store, open_archive())
    assert illustration.task == "upper-body-missing"
    assert set(illustration.groups) == {"truth", "nn", "trivial"}
    assert illustration.title == "Filled channels: synthetic walks (synthetic)"
    assert illustration.title in (finished / "report.html").read_text()


def test_predictions_that_are_gone_are_not_shown(store):
    records = [Record(**{**vars(record), "fit_key": "gone"}) for record in store.records()]
    assert illustrations(records, store, open_archive()) == ()


def test_a_case_that_nobody_named_is_not_shown(store, monkeypatch):
    monkeypatch.setattr(TASKS.get("upper-body-missing"), "illustrated", (), raising=False)
    assert illustrations(store.records(), store, open_archive()) == ()


def test_recordings_that_are_gone_leave_the_report_without_them(store, monkeypatch):
    archive = open_archive()

    def unavailable(uri):
        raise RecordingUnavailable(uri, "fetch it")

    monkeypatch.setattr(archive, "read", unavailable)
    assert illustrations(store.records(), store, archive) == ()
