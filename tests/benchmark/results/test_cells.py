"""The numbers that the page embeds for its cells are those of the exported tables."""

import base64
import json
import re
import shutil

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from mocapbench.benchmark.runs.record import Status

TASK, CASES, LABELS = "toy-interpolation-1", ("test 1", "test 2"), ("mohgp-3", "knn")
ROWS = [(TASK, case, label, fold) for case in CASES for label in LABELS for fold in range(4)]
BROKEN, ALONE = (TASK, "test 1", "knn", 2), (TASK, "test 3", "knn", 0)


@pytest.fixture
def path(cli, tmp_path, write_run):
    values = np.random.default_rng(3).lognormal(0.0, 2.0, len(ROWS) + 1)
    scores = dict(zip([*ROWS, ALONE], values, strict=True))
    path = write_run(
        tmp_path / "run", [*ROWS, ALONE], scores=scores, statuses={BROKEN: Status.FAILED}
    )
    shutil.rmtree(path / "predictions")  # which are of no problem that there is
    assert cli("report", "--out", path) == 0
    assert cli("export", path) == 0
    return path


@pytest.fixture
def document(path):
    page = (path / "report.html").read_text(encoding="utf-8")
    ((text,),) = [re.findall(r'<script type="application/json" id="cells">(.*)</script>', page)]
    return json.loads(text)


@pytest.fixture
def cells(document):
    """Return each cell by (task, case, label), with what it shares with others in its place."""
    shared, found = document["shared"], {}
    for task, about in document["tasks"].items():
        metrics = [name for name, *_ in about["metrics"]]
        for row in about["rows"]:
            cell = dict(zip(document["columns"], row, strict=True))
            for name in ("case", "label", "model", "parameters", "recordings"):
                cell[name] = shared[cell[name]]
            cell["command"] = " ".join(shared[place] for place in cell["command"])
            cell["scores"] = dict(zip(metrics, cell["scores"], strict=True))
            found[task, cell["case"], cell["label"]] = cell
    return found


def test_every_number_is_that_of_the_exported_table(path, cells):
    exported = pd.read_csv(path / "scores.csv").groupby(["task", "case", "label"])
    assert set(cells) == set(exported.groups)
    for address, rows in exported:
        cell = cells[address]
        by_fold = rows.set_index("fold")["value"]
        values, mean, half, *_ = cell["scores"]["mse"]
        filled = by_fold.reindex(cell["folds"])
        np.testing.assert_allclose(np.array(values, float), filled, rtol=1e-5)
        np.testing.assert_allclose(mean, by_fold.mean(), rtol=1e-5)
        if len(by_fold) == 1:
            assert half is None
        else:
            low, high = stats.t.interval(0.95, len(by_fold) - 1, by_fold.mean(), by_fold.sem())
            np.testing.assert_allclose([mean - half, mean + half], [low, high], rtol=2e-4)


def test_keys_seeds_and_costs_are_those_of_the_exported_tables(path, cells):
    scores, jobs = (pd.read_csv(path / f"{name}.csv") for name in ("scores", "jobs"))
    keys = scores.set_index(["task", "case", "label", "fold"])["key"]
    for address, cell in cells.items():
        raw = base64.b64decode(cell["keys"]).hex()
        named = dict(zip(cell["folds"], re.findall(".{64}", raw), strict=True))
        scored = {fold: keys[*address, fold] for fold in cell["folds"] if (*address, fold) in keys}
        assert {fold: named[fold] for fold in scored} == scored
    assert {cell["seed"] for cell in cells.values()} == set(scores["seed"])
    assert {second for cell in cells.values() for second in cell["fit_seconds"]} - {None} == set(
        jobs["fit_seconds"].dropna()
    )


def test_a_job_without_a_score_says_why(document, cells):
    ((fold, status, message, anchor),) = cells[BROKEN[:3]]["failures"]
    told = (fold, document["shared"][status], document["shared"][message], anchor)
    assert told == (2, "failed", "by run", "job-1")
    assert cells[BROKEN[:3]]["scores"]["mse"][0][2] is None


def test_the_command_stands_beside_its_cell(cells):
    assert cells[TASK, "test 2", "knn"]["command"] == (
        f"mocapbench run --profile quick --seed 0 --tasks {TASK} --cases 'test 2' --models knn "
        "--folds 4 --out mocapbench-cell"
    )
