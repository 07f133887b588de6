"""Models are compared by the paired statistics of the project, over gaps that are independent."""

import re

import numpy as np
import pandas as pd
import pytest

from mocapbench import compare
from mocapbench.metrics.statistics import holm, t_test


def table(values, positions=None, metric="mse", recordings=1):
    """Return scores of models by their values, one a gap."""
    rows = []
    for model, of_model in values.items():
        for k, value in enumerate(of_model):
            position = k if positions is None else positions[k]
            place = {"recording": f"r{k % recordings}", "gap": k, "position": position}
            rows.append({**place, "model": model, "metric": metric, "value": value})
    return pd.DataFrame(rows)


RNG = np.random.default_rng(0)
VALUES = {"a": RNG.normal(1, 0.1, 8), "b": RNG.normal(1.6, 0.1, 8)}
VALUES["c"] = VALUES["b"] + 0.05 * np.array([1, -1, 1, -1, 1, -1, 1, 0])


def test_every_two_models_have_a_row_the_better_one_first():
    found = compare(table(VALUES))
    assert len(found) == 3
    assert found["first"].tolist()[:2] == ["a", "a"]
    assert (found["advantage"] >= 0).all()
    assert (found["mean_second"] - found["mean_first"]).tolist() == pytest.approx(
        found["advantage"].tolist()
    )


def test_the_tests_are_paired_and_corrected():
    found = compare(table(VALUES))
    for row in found.itertuples():
        assert row.p == pytest.approx(t_test(VALUES[row.second] - VALUES[row.first]))
    np.testing.assert_allclose(found["p_holm"], holm(found["p"]))
    assert found["verdict"].tolist() == ["more than chance"] * 2 + ["may be chance"]


def test_gaps_at_one_position_are_one_unit():
    alone = compare(table(VALUES))
    together = compare(table(VALUES, positions=[0, 0, 0, 0, 1, 1, 2, 3]))
    assert (alone["n"] == 8).all()
    assert (together["n"] == 4).all()
    assert {*together["verdict"]} == {"too few to test"}
    np.testing.assert_allclose(together["advantage"], alone["advantage"])


def test_recordings_can_be_the_units():
    found = compare(table(VALUES, recordings=4), by="recording")
    assert found["n"].tolist() == [4] * 3


def test_of_a_metric_with_a_target_the_nearer_is_better():
    found = compare(table({"far": [0.5] * 6, "near": [0.94, 0.96] * 3}, metric="coverage_95"))
    assert found["first"].tolist() == ["near"]


def test_a_model_without_scores_is_not_compared_by_that_metric():
    scores = pd.concat([table(VALUES), table({"a": [np.nan] * 8, "b": VALUES["b"]}, metric="crps")])
    assert {*compare(scores)["metric"]} == {"mse"}


@pytest.mark.parametrize(
    ("scores", "options", "said"),
    [
        (table(VALUES).drop(columns="gap"), {}, "got none called gap"),
        (None, {}, "expected the table that evaluate returns, got NoneType"),
        (table(VALUES).assign(value="x"), {}, "expected numbers in the column value"),
        (table(VALUES), {"by": "model"}, "expected by= as one of gap, recording, got 'model'"),
        (table({"a": [1.0]}), {}, "expected two models or more, got 1"),
        (pd.concat([table(VALUES)] * 2), {}, "expected one score of each, got several of"),
        (table({"a": [np.nan], "b": [1.0]}), {}, "expected scores that two models have in common"),
    ],
)
def test_what_cannot_be_compared_is_refused(scores, options, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        compare(scores, **options)
