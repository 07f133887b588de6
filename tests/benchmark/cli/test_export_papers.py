"""``mocapbench export --format``: tables for papers of what is named, or one clear line."""

import importlib
import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mocapbench.benchmark.runs.directory import RunDirectory

TASK = "toy-interpolation-1"
LABELS = ("mohgp-3", "knn", "trivial")
ROWS = [
    (TASK, case, label, fold)
    for case in ("test 1", "test 2")
    for label in LABELS[:2]
    for fold in range(6)
]


@pytest.fixture
def run(tmp_path, write_run):
    values = np.random.default_rng(3).lognormal(0.0, 0.5, len(ROWS))
    return write_run(tmp_path / "run", ROWS, scores=dict(zip(ROWS, values, strict=True)))


def test_all_formats_have_the_same_numbers(cli, run, tmp_path):
    to = tmp_path / "paper"
    assert cli("export", run, "--to", to, "--format", "latex,markdown,csv,parquet,xlsx") == 0
    assert {path.name for path in to.iterdir()} == {
        f"tables.{end}" for end in ("tex", "md", "csv", "parquet", "xlsx")
    }
    means = pd.read_parquet(to / "tables.parquet")
    pd.testing.assert_frame_equal(means, pd.read_csv(to / "tables.csv"), check_dtype=False)
    pd.testing.assert_frame_equal(means, pd.read_excel(to / "tables.xlsx"), check_dtype=False)
    shown = (to / "tables.md").read_text(encoding="utf-8")
    latex = (to / "tables.tex").read_text(encoding="utf-8")
    assert len(means) == 6
    for row in means.itertuples():
        assert f"± {row.half_width:.2f}" in shown
        assert rf"\pm {row.half_width:.2f}" in latex
    assert cli("export", run, "--to", to) == 0
    scores = pd.read_csv(to / "scores.csv")
    first = means[(means["case"] == "test 1") & (means["label"] == "knn")]["mean"].item()
    own = scores[(scores["case"] == "test 1") & (scores["label"] == "knn")]
    assert first == pytest.approx(own["value"].mean())


def test_models_are_named_by_label_or_model_and_cases_by_how_they_begin(cli, run, tmp_path):
    chosen = ("--models", "knn", "--models", "mohgp-3", "--cases", "test 2, test 1")
    assert cli("export", run, "--to", tmp_path, "--format", "csv", *chosen) == 0
    means = pd.read_csv(tmp_path / "tables.csv")
    assert [*dict.fromkeys(means["label"])] == ["knn", "mohgp-3"]
    assert [*dict.fromkeys(means["case"])] == ["mean of 2 cases", "test 2", "test 1"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--format", "latx"), "unknown format 'latx': did you mean latex"),
        (
            ("--format", "latex", "--tasks", "toy"),
            f"unknown task of this run 'toy': known: {TASK}",
        ),
        (
            ("--format", "latex", "--models", "kn"),
            "unknown model of this run 'kn': did you mean knn",
        ),
        (("--format", "latex", "--cases", "test 7"), "unknown case of this run 'test 7'"),
        (("--format", "latex", "--metrics", "mes"), "unknown metric of this run 'mes': .*mse"),
        (("--tasks", TASK), "add --format with any of latex, markdown, csv, parquet"),
        (("--format", "latex", "--tasks", ","), "expected names, got none"),
    ],
)
def test_what_is_not_there_is_one_line_and_writes_nothing(cli, run, tmp_path, options, said):
    assert cli("export", run, "--to", tmp_path / "new", *options) == 2
    assert re.search(said, cli.printed)
    assert not (tmp_path / "new").exists()


def test_a_file_that_is_there_stays(cli, run, tmp_path):
    (tmp_path / "tables.md").write_text("mine")
    assert cli("export", run, "--to", tmp_path, "--format", "latex,markdown") == 2
    assert "tables.md, which would be overwritten; name another folder with --to" in cli.printed
    assert (tmp_path / "tables.md").read_text() == "mine"
    assert not (tmp_path / "tables.tex").exists()


def test_a_model_without_a_score_is_named_and_without_any_there_is_no_table(
    cli, tmp_path, write_run
):
    scores = {(TASK, "test 1", "knn", fold): 1.0 for fold in range(2)}
    scores[TASK, "test 2", "mohgp-3", 0] = 1.0
    run = write_run(tmp_path / "run", [*scores], scores=scores)
    given = ("export", run, "--to", tmp_path, "--cases", "test 1", "--format", "csv")
    assert cli(*given, "--models", "mohgp-3") == 2
    assert "no score of what is chosen" in cli.printed
    assert cli(*given, "--models", "knn,mohgp-3") == 0
    assert "without a score there, so not shown: mohgp-3" in cli.printed


def test_a_metric_by_which_none_has_a_score_is_named(cli, tmp_path, write_run):
    rows = [(TASK, "test 1", label, 0) for label in ("knn", "mohgp-3")]
    run = write_run(tmp_path / "run", rows)
    store = RunDirectory(run)
    (last,) = (record for record in store.planned() if record.address.label == "mohgp-3")
    store.save(replace(last, scores={**last.scores, "crps": 1.0}))
    given = ("export", run, "--to", tmp_path, "--format", "csv", "--models", "knn")
    assert cli(*given, "--metrics", "mse,crps") == 0
    assert "without a score there, so not shown: crps" in cli.printed


@pytest.mark.parametrize("name", ["parquet", "xlsx"])
def test_a_format_without_its_package_says_how_to_get_it(cli, run, tmp_path, monkeypatch, name):
    module = importlib.import_module("mocapbench.benchmark.cli.export")
    monkeypatch.setattr(module, "find_spec", {}.get)
    assert cli("export", run, "--to", tmp_path, "--format", name) == 2
    assert f"pip install 'mocapbench[{name}]'" in cli.printed
