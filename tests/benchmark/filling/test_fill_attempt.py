"""Attempts to fill: constant channels stay constant, and windows put together make the whole."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.filling.fill_attempt import attempt_fill, keep_constants
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import Recording


@pytest.fixture
def floor(waves):
    """Return three markers on their way, and the point below one of them on the floor."""
    path = waves(200).values
    values = np.hstack([path[:, :3], path[:, 1:], path[:, [3, 0, 2]] + 5.0, path[:, :2] + 9.0])
    values = np.hstack([values, np.full((200, 1), 0.25)])
    names = [f"{name}.{axis}" for name in ("A", "B", "C", "floor") for axis in "xyz"]
    return Recording("walk", np.arange(200) / 50, values, names, ["mm"] * 12)


def problem(recording, first=50, stop=80, train=()):
    target = np.zeros(recording.values.shape, dtype=bool)
    target[first:stop, 9:] = True
    return GapProblem(recording.hide(target), target, train)


@pytest.mark.parametrize("model", ["linear", "rigid-body", "low-rank", "channel-kriging"])
def test_a_constant_channel_stays_constant_whatever_the_model(floor, model):
    asked = problem(floor)
    prediction = attempt_fill(MODELS.get(model), asked, 2**40).prediction
    assert (prediction.mean.reshape(-1, 3)[:, 2] == 0.25).all()
    assert len(np.unique(prediction.mean.reshape(-1, 3)[:, 0])) > 1


def kept(asked):
    """Return whether the constant channel is kept, where a model says 7 throughout."""
    filled = PredictedEntries(
        np.full(int(asked.target.sum()), 7.0), np.ones(int(asked.target.sum()))
    )
    means = keep_constants(asked, filled).mean.reshape(-1, 3)
    assert (means[:, :2] == 7.0).all()
    assert set(np.unique(means[:, 2])) <= {0.25, 7.0}
    return bool((means[:, 2] == 0.25).all())


@pytest.mark.parametrize(("seen", "is_kept"), [(1, False), (2, False), (9, False), (10, True)])
def test_few_equal_frames_before_a_long_gap_are_equal_by_chance(floor, seen, is_kept):
    assert kept(problem(floor, seen, 200)) == is_kept


@pytest.mark.parametrize(("hidden", "is_kept"), [(4, True), (5, True), (6, False)])
def test_few_frames_are_enough_if_they_are_most(floor, hidden, is_kept):
    assert kept(problem(floor.frames(np.arange(10)), 10 - hidden, 10)) == is_kept


def test_a_channel_that_moves_elsewhere_is_not_constant(floor):
    moving = np.array(floor.values)
    moving[0, 11] = 0.5
    other = replace(floor, name="other")
    assert not kept(problem(floor.with_values(moving)))
    assert kept(problem(floor, train=(other,)))
    assert not kept(problem(floor, train=(other.with_values(moving),)))


def test_a_channel_that_is_visible_nowhere_is_left_to_the_model(floor):
    other = replace(floor, name="other")
    assert not kept(problem(floor, 0, 200, train=(other,)))


class ShortLinear(LinearImputer):
    """Takes recordings of sixty frames."""

    max_frames = 60


def test_a_line_is_the_same_in_windows_and_they_are_counted(waves, hidden):
    mask = hidden((50, 58, [0, 1]), (100, 104, [2]), (108, 112, [3]), (150, 170, [0]))
    asked = GapProblem(waves().hide(mask), mask)
    whole, cut = (attempt_fill(model, asked, 2**40) for model in (LinearImputer, ShortLinear))
    np.testing.assert_allclose(cut.prediction.mean, whole.prediction.mean, rtol=1e-12)
    assert (whole.n_windows, cut.n_windows) == (0, 3)
