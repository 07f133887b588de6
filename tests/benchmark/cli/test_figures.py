"""``mocapbench figures``: each figure has its data and its command; what is wrong is one line."""

import importlib
import re
import shlex

import numpy as np
import pandas as pd
import pytest

from mocapbench.reports import FIGURE_KINDS
from mocapbench.reports.export.latex import escape_latex

TASK = "toy-interpolation-1"
LABELS = ("mohgp-3", "knn", "trivial")
ROWS = [
    (TASK, case, label, fold)
    for case in ("test 1", "test 2")
    for label in LABELS
    for fold in range(6)
]


@pytest.fixture
def run(tmp_path, write_run, nothing_here):
    values = np.random.default_rng(3).lognormal(0.0, 0.5, len(ROWS))
    return write_run(tmp_path / "run", ROWS, scores=dict(zip(ROWS, values, strict=True)))


def test_each_figure_has_its_data_its_caption_and_its_command(cli, run):
    assert cli("figures", run, "--format", "pdf,svg") == 0
    folder = run / "figures"
    names = {path.stem for path in folder.iterdir()}
    assert names == {
        f"{TASK}-{end}" for end in ("error-bars-mse", "by-case", "ranks-mse", "cost-mse")
    }
    for name in names:
        assert {path.suffix for path in folder.glob(f"{name}.*")} == {
            ".pdf",
            ".svg",
            ".csv",
            ".txt",
            ".tex",
        }
    assert f"4 figures: {folder}" in cli.printed
    assert f"no calibration of {TASK}: no model has the coverage" in cli.printed
    assert f"no covariances of {TASK}: the run keeps no covariance of it" in cli.printed


def test_the_command_beside_a_figure_draws_it_again_to_the_byte(cli, run, tmp_path):
    chosen = ("--kinds", "error-bars", "--models", "knn,trivial", "--width", "90mm")
    assert cli("figures", run, *chosen, "--to", tmp_path / "a", "--style", "slides") == 0
    folder, again = tmp_path / "a", tmp_path / "b"
    text = (folder / f"{TASK}-error-bars-mse.txt").read_text(encoding="utf-8")
    program, *words = shlex.split(text.strip().splitlines()[-1])
    assert program == "mocapbench"
    assert cli(*(word.replace(f"{folder}", f"{again}") for word in words)) == 0
    for name in (f"{TASK}-error-bars-mse.pdf", f"{TASK}-error-bars-mse.csv"):
        assert (folder / name).read_bytes() == (again / name).read_bytes()


def test_the_numbers_are_those_of_the_table_for_a_paper(cli, run, tmp_path):
    assert cli("figures", run, "--kinds", "error-bars", "--to", tmp_path) == 0
    assert cli("export", run, "--to", tmp_path, "--format", "csv") == 0
    drawn = pd.read_csv(tmp_path / f"{TASK}-error-bars-mse.csv")
    means = pd.read_csv(tmp_path / "tables.csv").set_index(["case", "label"])
    for row in drawn.drop_duplicates(["panel", "label"]).itertuples():
        ours = means.loc[(row.panel, row.label)]
        assert row.mean == ours["mean"]
        assert row.high - row.mean == pytest.approx(ours["half_width"])
    assert len(drawn[drawn["panel"] == "test 1"]) == 18


def test_a_figure_for_latex_names_its_file_and_has_the_caption(cli, run, tmp_path):
    assert cli("figures", run, "--kinds", "error-bars", "--cases", "test 1", "--to", tmp_path) == 0
    name = f"{TASK}-error-bars-mse"
    caption = (tmp_path / f"{name}.txt").read_text(encoding="utf-8").splitlines()[0]
    assert ", test 1. Large markers are means, bars their 95 % intervals" in caption
    assert "single values, of 6 folds." in caption
    lines = (tmp_path / f"{name}.tex").read_text(encoding="utf-8").splitlines()
    assert lines == [
        r"\begin{figure}",
        r"  \centering",
        rf"  \includegraphics{{{name}.pdf}}",
        rf"  \caption{{{escape_latex(caption)}}}",
        rf"  \label{{fig:{name}}}",
        r"\end{figure}",
    ]
    assert "95 \\%" in lines[3]


@pytest.mark.parametrize(
    ("formats", "shown"), [("svg,pdf", ".pdf"), ("svg,png", ".png"), ("svg", None)]
)
def test_latex_is_given_what_it_can_show(cli, run, tmp_path, formats, shown):
    given = ("--kinds", "error-bars", "--format", formats, "--to", tmp_path)
    assert cli("figures", run, *given) == 0
    texts = [path.read_text(encoding="utf-8") for path in tmp_path.glob("*.tex")]
    assert [re.search(r"includegraphics{.*(\.\w+)}", text)[1] for text in texts] == [
        *filter(None, [shown])
    ]


def test_cases_that_are_named_are_drawn_alone_also_by_the_command_beside(cli, run, tmp_path):
    chosen = ("--kinds", "error-bars", "--cases", "*2", "--to", tmp_path)
    assert cli("figures", run, *chosen) == 0
    drawn = pd.read_csv(tmp_path / f"{TASK}-error-bars-mse.csv")
    assert {*drawn["panel"]} == {"test 2"}
    text = (tmp_path / f"{TASK}-error-bars-mse.txt").read_text(encoding="utf-8")
    assert "--cases=*2" in shlex.split(text.strip().splitlines()[-1])


def test_a_model_has_the_same_colour_beside_all_others_and_alone(cli, run, tmp_path):
    given = ("--kinds", "error-bars", "--format", "svg")
    for name, models in (("all", LABELS), ("one", LABELS[1:2])):
        out = tmp_path / name
        assert cli("figures", run, *given, "--models", ",".join(models), "--to", out) == 0
    texts = [(tmp_path / n / f"{TASK}-error-bars-mse.svg").read_text() for n in ("all", "one")]
    colours = [{*re.findall(r"(?:fill|stroke): (#\w{6})", text)} for text in texts]
    alone = {colour for colour in colours[1] if colour not in {"#000000", "#ffffff"}}
    assert alone
    assert alone < colours[0]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--kinds", "error-bar"), "unknown kind of figure 'error-bar': did you mean error-bars"),
        (("--format", "eps"), "unknown format 'eps': known: pdf, svg and png"),
        (("--style", "poster"), "unknown style 'poster': did you mean paper"),
        (("--width", "wide"), "expected a width from 2.54cm to 152cm, such as 8.4cm.*got 'wide'"),
        (("--width", "1mm"), "expected a width from 2.54cm to 152cm"),
        (("--width", "-8cm"), "expected a width from 2.54cm"),
        (("--tasks", "toy"), f"unknown task of this run 'toy': known: {TASK}"),
        (("--cases", "test 3"), "unknown case of this run 'test 3': did you mean test 2 or test 1"),
        (("--models", "kn"), "unknown model of this run 'kn': did you mean knn"),
        (("--metrics", "mes"), "unknown metric of this run 'mes'.*mse"),
        (("--kinds", "calibration"), "no data for any figure of what is chosen"),
        (("--kinds", ","), "expected names, got none"),
    ],
)
def test_what_is_not_there_is_one_line_and_writes_nothing(cli, run, tmp_path, options, said):
    assert cli("figures", run, "--to", tmp_path / "new", *options) == 2
    assert re.search(said, cli.printed)
    assert not (tmp_path / "new").exists()


def test_the_help_names_every_kind(cli):
    assert cli("figures", "--help") == 0
    listed = re.sub(r"[│\s]+", " ", cli.printed)
    assert all(kind in listed for kind in FIGURE_KINDS)


def test_a_folder_that_is_no_run_is_named(cli, tmp_path):
    assert cli("figures", tmp_path) == 2
    assert str(tmp_path) in cli.printed
    assert not (tmp_path / "figures").exists()


def test_without_seaborn_it_says_how_to_get_it(cli, run, monkeypatch):
    module = importlib.import_module("mocapbench.benchmark.cli.figures")
    monkeypatch.setattr(module, "find_spec", {}.get)
    assert cli("figures", run) == 2
    assert "pip install 'mocapbench[figures]'" in cli.printed
