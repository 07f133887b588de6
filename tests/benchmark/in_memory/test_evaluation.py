"""Scores are those of the metrics, of values that no model saw."""

import re
from typing import ClassVar

import numpy as np
import pytest
from sklearn.impute import KNNImputer

import mocapbench
from mocapbench.baselines import Imputer, LinearImputer, Prediction
from mocapbench.datasets import Recording
from mocapbench.metrics import Imputation, mse

HIDE = mocapbench.Gaps(0.25, count=6, seed=3)


class Looks(Imputer):
    """A model that keeps what it was given."""

    seen: ClassVar = []

    def fit(self, recordings):
        self.seen += recordings
        return self

    def impute(self, recordings):
        return [Prediction.around(one, 0.0, 1.0) for one in recordings]


@pytest.fixture(scope="module")
def scores():
    recordings = [mocapbench.read(wave(seed), rate=60, name=f"wave {seed}") for seed in range(2)]
    return mocapbench.evaluate(recordings, ["linear", "cubic-spline"], HIDE)


def wave(seed):
    phases = np.random.default_rng(seed).uniform(0, 6, 9)
    return np.sin(2 * np.pi * np.arange(300)[:, None] / 60 + phases)


def test_each_gap_has_a_score_of_each_model_by_each_metric(scores):
    counts = scores.groupby(["recording", "model", "metric"])["gap"].nunique()
    assert (counts == 6).all()
    assert {*scores["model"]} == {"linear", "cubic-spline"}
    assert {"mse", "smse"} <= {*scores["metric"]}
    assert not scores.duplicated(["recording", "gap", "model", "metric"]).any()


def test_metrics_that_no_model_has_are_left_out_unless_they_are_named(scores):
    assert "crps" not in {*scores["metric"]}
    named = mocapbench.evaluate(wave(0), ["linear"], HIDE, metrics=["crps"], rate=60)
    assert named["value"].isna().all()
    assert len(named) == 6


def test_a_score_is_that_of_the_metric_in_the_gap_alone(walk):
    recording = walk()
    scores = mocapbench.evaluate(recording, "linear", HIDE, metrics="mse")
    hidden = np.zeros(recording.values.shape, dtype=bool)
    gaps = HIDE.place(recording)
    for gap in gaps:
        hidden[gap.start : gap.stop, list(gap.channels)] = True
    given = recording.hide(hidden)
    (filled,) = LinearImputer().fit([given]).impute([given])
    for gap, found in zip(gaps, scores["value"], strict=True):
        own = np.zeros_like(hidden)
        own[gap.start : gap.stop, list(gap.channels)] = True
        outcome = Imputation(recording.values, filled.mean, None, own, np.zeros(12), np.ones(12))
        assert found == pytest.approx(mse(outcome).value)


def test_errors_of_frames_have_the_score_of_the_gap_as_their_mean(walk):
    models = ["linear", "pchip"]
    frames = mocapbench.evaluate_frames(walk(), models, HIDE)
    scores = mocapbench.evaluate(walk(), models, HIDE, metrics=["rms_per_frame"])
    of_gap = ["recording", "gap", "model", "metric", "position", "start", "hidden"]
    means = frames.groupby(of_gap)["value"].mean()
    np.testing.assert_allclose(means[scores[of_gap].itertuples(index=False)], scores["value"])
    for gap, own in frames[frames["model"] == "pchip"].groupby("gap"):
        placed = HIDE.place(walk())[gap - 1]
        np.testing.assert_array_equal(own["time"], walk().times[placed.start : placed.stop])


def test_a_metric_without_frames_is_refused(walk):
    with pytest.raises(ValueError, match="smse is not defined for the frames of these gaps"):
        mocapbench.evaluate_frames(walk(), "linear", HIDE, metric="smse")


def test_no_model_sees_what_is_hidden(walk):
    Looks.seen.clear()
    mocapbench.evaluate(walk(), [Looks()], HIDE)
    (seen,) = Looks.seen
    for gap in HIDE.place(walk()):
        channels = [walk().channels[channel] for channel in gap.channels]
        assert not seen.select(channels).visible[gap.start : gap.stop].any()


def test_ones_own_gaps_are_filled_and_not_scored(gappy):
    Looks.seen.clear()
    scores = mocapbench.evaluate(gappy, {"mine": Looks(), "k": KNNImputer()}, HIDE)
    assert {*scores["model"]} == {"mine", "k"}
    assert scores.query("metric == 'mse'")["value"].notna().all()
    assert {"crps", "coverage_95"} <= {*scores.query("model == 'mine'").dropna()["metric"]}
    assert scores.query("model == 'k' and metric == 'crps'")["value"].isna().all()


def test_channels_that_nobody_measured_are_not_judged(walk):
    recording = walk(name="one")
    lost = np.zeros((240, 12), dtype=bool)
    lost[:, :3] = True
    scores = mocapbench.evaluate([recording.hide(lost), recording], "linear", HIDE, metrics="mse")
    of_first = scores[scores["recording"] == "one"]
    assert "LKNE" not in {*of_first["hidden"]}
    assert {*scores["recording"]} == {"one", "one 2"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (([], "linear"), "expected one recording or more, got none"),
        ((None, []), "expected models of different names, got none"),
        ((None, [Looks(), Looks()]), "got Looks several times; name them"),
        ((None, "liner"), "did you mean linear"),
        ((None, Looks), "got the class Looks; write Looks()"),
    ],
)
def test_what_cannot_be_evaluated_is_refused(walk, arguments, said):
    recordings, models = arguments
    with pytest.raises(ValueError, match=re.escape(said)):
        mocapbench.evaluate(walk() if recordings is None else recordings, models, HIDE)


def test_an_unknown_metric_is_refused_before_any_model_runs(walk):
    with pytest.raises(ValueError, match="did you mean mse"):
        mocapbench.evaluate(walk(), "linear", HIDE, metrics=["mse_"])


def test_of_nothing_nothing_is_scored(walk):
    nothing = walk().with_values(np.full((240, 12), np.nan))
    with pytest.raises(ValueError, match="expected a visible channel, got none"):
        mocapbench.evaluate(nothing, "linear", HIDE)


@pytest.mark.slow
def test_the_best_is_chosen_without_a_look_at_what_is_hidden(walk):
    scores = mocapbench.evaluate(walk(), ["best", "hold"], HIDE, metrics="mse", effort="low")
    means = scores.groupby("model")["value"].mean()
    assert means["best"] < means["hold"]


def test_angles_are_not_unwrapped_again_where_a_gap_is_hidden():
    """Over a gap in which an angle grows by 250°, those behind it would be taken for 360° less."""
    times = np.arange(300) / 60
    spinning = Recording("spinning", times, 500 * times[:, None], ["root.ry"], ["deg"])
    scores = mocapbench.evaluate(spinning, "linear", mocapbench.Gaps(0.5, count=3), metrics="mse")
    np.testing.assert_allclose(scores["value"], 0.0, atol=1e-9)
