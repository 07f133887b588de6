"""The printed values of motion prediction are those of the list that was gathered of them."""

import csv
from collections import Counter

import pytest
from shared_files import shared

from mocapbench.reports.paper.published import every_value

TASKS = {
    "3-D mm, all windows": "motion-prediction",
    "3-D mm, 8 seeds": "motion-prediction-8-windows",
}
TASKS["angle, 8 seeds"] = TASKS["3-D mm, 8 seeds"]


@pytest.fixture(scope="module")
def gathered():
    text = shared("cmu-prediction", "published.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return [row for row in rows if row["source"] != "computed"]


def ours():
    return [value for value in every_value() if value.task in TASKS.values()]


def test_every_gathered_value_is_here_and_no_other(gathered):
    numbers = [float(row["value"].partition(" ")[0]) for row in gathered]
    expected = Counter(
        (TASKS[row["manner"]], row["action"], number)
        for row, number in zip(gathered, numbers, strict=True)
    )
    assert Counter((v.task, v.case, v.value) for v in ours()) == expected


def test_values_at_six_horizons_are_those_of_the_model_and_horizon(gathered):
    found = {(v.task, v.case, v.metric, v.value) for v in ours()}
    models = {v.model.partition(" (")[0] for v in ours()}
    for row in gathered:
        if row["manner"].startswith("3-D") and row["horizon_ms"] in ("80", "160", "320", "400"):
            metric = f"MPJPE at {row['horizon_ms']} ms"
            assert (TASKS[row["manner"]], row["action"], metric, float(row["value"])) in found
        assert row["model"].partition(" (")[0] in models | {"LTD"}


def test_printed_values_of_one_model_that_differ_stand_side_by_side():
    by_model = {
        v.model: v.value
        for v in ours()
        if (v.task, v.case, v.metric) == ("motion-prediction", "walking", "MPJPE at 1000 ms")
        if v.model.startswith("MSR-GCN")
    }
    assert by_model.keys() >= {"MSR-GCN (Dang 2021)", "MSR-GCN (released checkpoint)"}
    assert len(set(by_model.values())) > 1


def test_a_mean_that_leaves_out_an_action_is_not_comparable():
    reasons = {v.case: v.not_comparable for v in ours() if v.case.startswith("mean")}
    assert "running" in reasons["mean without running"]
    assert any(not v.not_comparable for v in ours() if v.case == "mean")
