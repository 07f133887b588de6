"""Three tasks of people who know pandas and nothing of us, each in at most twelve lines."""

import ast
import inspect

import numpy as np
import pandas as pd
import pytest

import mocapbench

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


@pytest.fixture
def table(gappy):
    """Return a table with gaps, as they have it."""
    return pd.DataFrame(gappy.values, gappy.times, gappy.channels)


@pytest.fixture
def whole(walk):
    """Return tables without gaps."""
    return [pd.DataFrame(walk(seed=n).values, walk().times, walk().channels) for n in range(2)]


def fill_by_three_models(table):
    filled = {name: mocapbench.fill(table, name) for name in ("linear", "makima", "marker-kriging")}
    return {name: one.to_dataframe() for name, one in filled.items()}


def plot_with_intervals(table):
    filled = mocapbench.fill(table, "marker-kriging")
    axes = filled.plot("LKNE", level=0.8)
    axes[0].set_title("Left knee")
    return axes


def score_two_models(tables):
    hide = mocapbench.Gaps(seconds=0.2, what="marker", count=6)
    scores = mocapbench.evaluate(tables, models=["linear", "cubic-spline"], hide=hide)
    means = scores.pivot_table(values="value", index="metric", columns="model")
    return means, mocapbench.compare(scores)


@pytest.mark.parametrize("task", [fill_by_three_models, plot_with_intervals, score_two_models])
def test_a_task_takes_at_most_twelve_lines(task):
    (function,) = ast.parse(inspect.getsource(task)).body
    lines = ast.unparse(function).splitlines()
    assert len([line for line in lines if line]) <= 11  # and the import


def test_three_models_fill_the_table(table):
    filled = fill_by_three_models(table)
    for one in filled.values():
        assert one.notna().all(axis=None)
        pd.testing.assert_frame_equal(one[table.notna()], table, check_names=False)
    assert len({one.to_numpy().tobytes() for one in filled.values()}) == 3


def test_the_plot_has_an_interval_around_what_was_filled(table):
    axes = plot_with_intervals(table)
    assert len(axes) == 3
    for one in axes:
        (band,) = one.collections
        assert band.get_label() == "80% interval"
        assert np.isfinite(band.get_paths()[0].vertices).all()


def test_scores_say_which_model_is_better(whole):
    means, compared = score_two_models(whole)
    assert {*means.columns} == {"linear", "cubic-spline"}
    assert {"first", "second", "p_holm", "verdict"} <= {*compared}
    of_mse = compared[compared["metric"] == "mse"].iloc[0]
    assert means.loc["mse", of_mse["first"]] < means.loc["mse", of_mse["second"]]
