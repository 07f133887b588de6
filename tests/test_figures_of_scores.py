"""Figures of scores in memory: the numbers on axes are those of the scores, by the same units."""

import numpy as np
import pandas as pd
import pytest
from scipy import stats

import mocapbench
from mocapbench.datasets import GaitLibrary

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

METRICS = ("mse", "coverage_50", "coverage_90")
MODELS = {"good": 1.0, "fair": 2.0, "poor": 5.0}


@pytest.fixture(autouse=True)
def close():
    """Close the figures of a test."""
    yield
    matplotlib.pyplot.close("all")


def make_scores(seconds=0.5, seed=0):
    """Return scores as `evaluate` returns them: of two recordings, each with six gaps."""
    rng = np.random.default_rng(seed)
    rows = [
        {"recording": name, "model": model, "gap": gap, "position": gap, "start": 1.0}
        | {"hidden": "LKNE", "metric": metric, "value": size * rng.uniform(0.9, 1.1)}
        for name in ("walk", "run")
        for model, size in MODELS.items()
        for gap in range(1, 7)
        for metric in METRICS
    ]
    scores = pd.DataFrame(rows)
    of_coverage = scores["metric"].str.startswith("coverage")
    scores["value"] = scores["value"].where(~of_coverage, rng.uniform(0.4, 0.9, len(rows)))
    return scores.assign(seconds=seconds)


def points_of(axes):
    """Return the points of markers and lines as one set of rows."""
    drawn = [c.get_offsets() for c in axes.collections if len(c.get_offsets()) > 1]
    return np.concatenate([np.ma.getdata(one) for one in drawn])


def test_dots_are_gaps_and_bars_are_means_with_their_intervals():
    scores = make_scores()
    axes = mocapbench.figures.error_bars(scores, "mse")
    assert [tick.get_text() for tick in axes.get_yticklabels()] == [*MODELS]
    own = scores[scores["metric"] == "mse"]
    points = points_of(axes)
    for place, model in enumerate(MODELS):
        values = own["value"][own["model"] == model].to_numpy()
        here = points[points[:, 1] == place][:, 0]
        assert np.isclose(values[:, None], here).any(axis=1).all()
        assert np.isclose(here, values.mean()).any()
        spread = stats.sem(values)
        low, high = stats.t.interval(0.95, len(values) - 1, values.mean(), spread)
        ends = [
            line
            for group in axes.collections
            if hasattr(group, "get_segments")
            for line in group.get_segments()
        ]
        assert any(np.allclose(line, [[low, place], [high, place]]) for line in ends)


def test_recordings_count_as_one_where_they_are_asked_for():
    scores = make_scores()
    axes = mocapbench.figures.error_bars(scores, "mse", by="recording")
    means = scores[scores["metric"] == "mse"].groupby(["model", "recording"])["value"].mean()
    assert np.isclose(means.to_numpy()[:, None], points_of(axes)[:, 0]).any(axis=1).all()


def test_it_draws_on_given_axes_and_returns_them():
    _, given = matplotlib.pyplot.subplots()
    assert mocapbench.figures.error_bars(make_scores(), ax=given) is given
    assert given.get_xlabel() == "MSE"
    lengths = pd.concat([make_scores(0.5), make_scores(2.0, seed=1)])
    _, given = matplotlib.pyplot.subplots()
    mocapbench.figures.along(lengths, "seconds", ax=given)
    assert {text.get_text() for text in given.get_legend().get_texts()} == {*MODELS}


def test_curves_along_a_column_are_means():
    scores = pd.concat([make_scores(0.5), make_scores(2.0, seed=1)])
    axes = mocapbench.figures.along(scores, "seconds")
    means = scores[scores["metric"] == "mse"].groupby(["model", "seconds"])["value"].mean()
    drawn = [line.get_xydata() for line in axes.lines]
    for model in MODELS:
        wanted = [*means[model].items()]
        assert any(np.shape(one) == (2, 2) and np.allclose(one, wanted) for one in drawn)


def test_coverage_is_drawn_against_its_nominal_value():
    scores = make_scores()
    axes = mocapbench.figures.calibration(scores)
    half = scores[(scores["metric"] == "coverage_50") & (scores["model"] == "good")]["value"].mean()
    assert any(np.isclose(line.get_xydata(), [0.5, half]).all(axis=1).any() for line in axes.lines)


def test_ranks_costs_and_recordings_are_drawn_too():
    scores = make_scores()
    axes = mocapbench.figures.ranks(scores)
    assert [*points_of(axes)[:, 0]] == [1.0, 2.0, 3.0]
    seconds = scores.assign(
        fit_seconds=scores["model"].map({"good": 9.0, "fair": 1.0, "poor": 2.0})
    )
    axes = mocapbench.figures.cost(seconds, "mse")
    assert {*points_of(axes)[:, 1]} == {9.0, 1.0, 2.0}
    assert len(mocapbench.figures.by_recording(scores)) == 1
    assert len(mocapbench.figures.by_recording(scores, "mse")) == 1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            lambda one: one.drop(columns="gap"),
            "expected the columns of evaluate, got none called gap",
        ),
        (
            lambda one: pd.concat([one, one]),
            "expected one score of each, as `evaluate` returns, got several of",
        ),
        (lambda one: one.assign(value=np.nan), "expected scores, got none that is a number"),
        (lambda one: one.iloc[:0], "expected scores, got none"),
    ],
)
def test_what_is_no_table_of_scores_is_refused(change, said):
    with pytest.raises(ValueError, match=said):
        mocapbench.figures.error_bars(change(make_scores()))


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda f, s: f.error_bars(s, "mes"), "unknown metric of these scores 'mes'"),
        (lambda f, s: f.error_bars(s, by="model"), "expected by= as one of gap, recording"),
        (
            lambda f, s: f.calibration(s[s["metric"] == "mse"]),
            "coverage of intervals at two levels",
        ),
        (lambda f, s: f.along(s, "length"), "got none called length"),
        (lambda f, s: f.along(s, "hidden"), "expected numbers in the column hidden"),
        (lambda f, s: f.along(s, "seconds"), "do not differ in seconds alone"),
        (lambda f, s: f.cost(s), "got none called fit_seconds"),
        (lambda f, s: f.ranks(s[s["gap"] == 1]), "too few cases or people"),
    ],
)
def test_what_cannot_be_drawn_is_said(draw, said):
    with pytest.raises(ValueError, match=said):
        draw(mocapbench.figures, make_scores())


def test_the_course_of_gaps_is_the_mean_of_each_model_at_each_place():
    walk = GaitLibrary().recording("01_01")
    errors = mocapbench.evaluate_frames(walk, ["linear", "pchip"], mocapbench.Gaps(1 / 6, count=4))
    axes = mocapbench.figures.along_gap(errors)
    places = (np.arange(20) + 0.5) / 20
    for model, own in errors.groupby("model"):
        courses = own["value"].to_numpy().reshape(4, 20)  # as many frames as places
        expected = np.column_stack([places, courses.mean(axis=0)])
        drawn = [line.get_xydata() for line in axes.get_lines()]
        assert any(one.shape == (20, 2) and np.allclose(one, expected) for one in drawn), model


def test_gaps_of_seven_frames_have_no_course():
    walk = GaitLibrary().recording("01_01")
    errors = mocapbench.evaluate_frames(walk, ["linear"], mocapbench.Gaps(7 / 120, count=2))
    with pytest.raises(ValueError, match="gaps of eight frames or more"):
        mocapbench.figures.along_gap(errors)
