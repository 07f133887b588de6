"""The numbers on the page of a run, computed again from its exported CSV with pandas and scipy.

Nothing here is shared with the code of the report: the page is read as HTML, the scores as CSV.
"""

import re
import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest
from scipy import stats

pytestmark = pytest.mark.slow

TASKS = ("toy-interpolation-1", "toy-synthesis", "missing-frames")
MODELS = "cubic-spline,linear,knn,nn,trivial,gp-independent,lds"
FOLDS = 6
ALPHA = 0.05


class Tables(HTMLParser):
    """The tables of a page by id: the heads and rows of cells, each with its attributes."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.row, self.cell = {}, None, None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if tag == "table":
            self.rows = self.tables.setdefault(given.get("id"), [])
        elif tag == "tr":
            self.row = {**given, "cells": []}
            self.rows.append(self.row)
        elif tag in ("td", "th"):
            self.cell = {**given, "text": "", "small": []}
            self.row["cells"].append(self.cell)
        elif tag == "small" and self.cell is not None:
            self.cell["small"].append("")
        self.within = tag

    def handle_endtag(self, tag):
        self.cell = None if tag in ("td", "th") else self.cell
        self.within = None

    def handle_data(self, data):
        if self.cell is not None and self.within == "small":
            self.cell["small"][-1] += data
        elif self.cell is not None:
            self.cell["text"] += data


def mocapbench(*arguments):
    code = "from mocapbench.benchmark.cli.main import main; main()"
    command = [sys.executable, "-c", code, *map(str, arguments)]
    subprocess.run(command, capture_output=True, timeout=500, check=True)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    out = tmp_path_factory.mktemp("run")
    chosen = ("--tasks", ",".join(TASKS), "--models", MODELS, "--folds", FOLDS, "--offline")
    mocapbench("run", "--profile", "smoke", *chosen, "--out", out)
    mocapbench("export", out)
    tables = Tables((out / "report.html").read_text(encoding="utf-8")).tables
    return pd.read_csv(out / "scores.csv"), tables


def first_table(tables, scores, task):
    """Return the first table of a task, and the metric that it is of."""
    metrics = {re.sub("[^a-z0-9]", "-", f"{task}-{name}"): name for name in scores["metric"]}
    name = next(name for name in tables if name in metrics)
    return tables[name], metrics[name]


def by_case(scores, task, metric):
    """Return the mean over folds of each label and case."""
    own = scores[(scores["task"] == task) & (scores["metric"] == metric)]
    return own.pivot_table(index="label", columns="case", values="value", aggfunc="mean")


def count_of(head):
    """Return how many cases the means are of, which is 1 where the head is a case's name."""
    counted = re.match(r"mean of (\d+) case", head["text"])
    return int(counted[1]) if counted else 1


def parts(tables, scores, task):
    """Return the rows of models, the names of cases, and how many of them count."""
    (heads, *rows), metric = first_table(tables, scores, task)
    names = [head["text"] for head in heads["cells"] if "case" in head.get("class", "").split()]
    counting = count_of(heads["cells"][1])
    return [row for row in rows if "published" not in row["class"]], names, counting, metric


@pytest.mark.parametrize("task", TASKS)
def test_means_of_cases_and_over_cases_are_those_of_the_scores(run, task):
    scores, tables = run
    rows, names, counting, metric = parts(tables, scores, task)
    wanted = by_case(scores, task, metric)
    cases = names or [*wanted.columns]
    assert len(rows) == len(wanted) > 1
    for row in rows:
        mean, *of_cases = [cell for cell in row["cells"] if "data-v" in cell and not lag(cell)]
        own = wanted.loc[row["data-model"]]
        assert float(mean["data-v"]) == pytest.approx(own[cases[:counting]].mean(), rel=1e-6)
        assert len(of_cases) == own[names].notna().sum()
        for cell, value in zip(of_cases, own[names].dropna(), strict=True):
            assert float(cell["data-v"]) == pytest.approx(value, rel=1e-6)
            assert float(cell["text"].replace("−", "-")) == pytest.approx(value, abs=0.006)


def lag(cell):
    return "lag" in cell.get("class", "").split()


def best(cell):
    return "best" in cell.get("class", "").split()


def lower_is_better(metric):
    return metric not in ("mcc", "mlc")


@pytest.mark.parametrize("task", TASKS)
def test_the_best_mean_is_bold_alone(run, task):
    scores, tables = run
    rows, _, _, metric = parts(tables, scores, task)
    means = {
        row["data-model"]: float(row["cells"][1]["data-v"])
        for row in rows
        if "ranked" in row["class"]
    }
    bold = [row["data-model"] for row in rows if best(row["cells"][1])]
    choose = min if lower_is_better(metric) else max
    assert bold == [choose(means, key=means.get)]


@pytest.mark.parametrize("task", TASKS)
def test_the_scoreboard_has_the_means_the_cases_and_the_units(run, task):
    scores, tables = run
    _, names, counting, metric = parts(tables, scores, task)
    board = tables["scoreboard"]
    heads = [cell for row in board[:2] for cell in row["cells"] if len(cell["small"]) == 3]
    means = by_case(scores, task, metric)
    cases = (names or [*means.columns])[:counting]
    wanted = means[cases].mean(axis=1)
    body = {row["data-model"]: row["cells"][1:] for row in board if "data-model" in row}
    column = next(
        place
        for place in range(len(heads))
        if all(matches(body[label][place], value) for label, value in wanted.items())
    )
    basis, units = heads[column]["small"][1:]
    kind = "synthetic case" if all("synthetic" in case for case in cases) else "case"
    assert basis == f"{counting} {kind}" + "s" * (counting != 1)
    independent = {"toy-interpolation-1", "toy-synthesis"}
    n_units = counting * FOLDS if task in independent else int(units.split()[0])
    assert int(units.split()[0]) == n_units


def matches(cell, value):
    return "data-v" in cell and float(cell["data-v"]) == pytest.approx(value, rel=1e-6)


def holm_intervals(differences):
    """Return the interval of each mean difference at the level at which Holm decides its test."""
    n = len(next(iter(differences.values())))
    p = {label: stats.ttest_1samp(units, 0.0).pvalue for label, units in differences.items()}
    level, rejecting = {}, True
    for place, label in enumerate(sorted(p, key=p.get)):
        if rejecting:
            step = ALPHA / (len(p) - place)
            rejecting = p[label] <= step
        level[label] = step
    found = {}
    for label, units in differences.items():
        half = stats.t.ppf(1.0 - level[label] / 2.0, n - 1) * stats.sem(units)
        found[label] = (np.mean(units) - half, np.mean(units) + half)
    return found


@pytest.mark.parametrize("task", ["toy-interpolation-1", "toy-synthesis"])
def test_differences_from_the_best_and_their_intervals(run, task):
    scores, tables = run
    rows, names, counting, metric = parts(tables, scores, task)
    own = scores[(scores["task"] == task) & (scores["metric"] == metric)]
    cases = (names or [*own["case"].unique()])[:counting]
    units = own[own["case"].isin(cases)].pivot_table(
        index=["case", "fold"], columns="label", values="value"
    )
    ranked = [row for row in rows if "ranked" in row["class"]]
    sign = 1.0 if lower_is_better(metric) else -1.0
    (leader,) = (row["data-model"] for row in ranked if best(row["cells"][1]))
    differences = {
        row["data-model"]: (sign * (units[row["data-model"]] - units[leader])).to_numpy()
        for row in ranked
        if row["data-model"] != leader
    }
    intervals = holm_intervals(differences)
    shown = {row["data-model"]: row["cells"][2] for row in ranked}
    assert intervals
    for label, (low, high) in intervals.items():
        cell = shown[label]
        assert float(cell["data-v"]) == pytest.approx(differences[label].mean(), rel=1e-5)
        printed = [float(text.replace("−", "-")) for text in cell["small"][0].split(" to ")]
        assert printed == pytest.approx([low, high], abs=0.006)
        assert cell["text"].strip().startswith("≈") == (low <= 0.0 <= high)
