from dataclasses import replace
from functools import partial

import pytest

from mocapbench.benchmark import (
    TASKS,
    Record,
    RunDirectory,
    archive_at,
    draw_filled_channels,
    draw_gap_error,
    illustrations,
)
from mocapbench.benchmark.cli.main import main
from mocapbench.datasets import RecordingUnavailable

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
    return RunDirectory(finished)


def _change_page(**changes):
    task = TASKS.get("upper-body-missing")
    TASKS.add(task.name, replace(task, page=replace(task.page, **changes)))


def test_a_report_shows_what_was_filled(finished, store):
    motion, illustration = illustrations(store.records(), store, archive_at())
    assert set(motion.motions) == {"nn", "trivial"}
    assert motion.beside == [*motion.motions][1]
    assert illustration.task == "upper-body-missing"
    assert set(illustration.groups) == {"truth", "nn", "trivial"}
    assert illustration.title == "Filled channels: synthetic walks (synthetic)"
    assert illustration.title in (finished / "report.html").read_text()


def test_predictions_that_are_gone_are_not_shown(store):
    records = [Record(**{**vars(record), "fit_key": "gone"}) for record in store.records()]
    assert illustrations(records, store, archive_at()) == ()


def test_a_case_that_no_page_names_is_not_shown(store):
    _change_page(illustrated=())
    assert illustrations(store.records(), store, archive_at()) == ()


def test_the_figures_are_those_that_the_page_declares(store):
    channels = ("lfemur.rx", "thorax.ry", "lowerback.rx")
    one, all_three = (
        partial(draw_filled_channels, channels=names) for names in (channels[:1], channels)
    )
    _change_page(figures=(draw_gap_error, one, all_three))
    one, three = illustrations(store.records(), store, archive_at())
    assert [panel.title for panel in one.axes] == list(channels[:1])
    assert [panel.title for panel in three.axes] == list(channels)


def test_recordings_that_are_gone_leave_the_report_without_them(store, monkeypatch):
    archive = archive_at()

    def unavailable(uri):
        raise RecordingUnavailable(uri, "fetch it")

    monkeypatch.setattr(archive, "recording", unavailable)
    assert illustrations(store.records(), store, archive) == ()
