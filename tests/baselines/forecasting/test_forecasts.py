"""Models that continue recordings: what each predicts, and what it says where it cannot."""

import numpy as np
import pytest

from mocapbench.baselines import ConstantVelocity, NeighbourForecast, ProcessForecast, RidgeForecast
from mocapbench.baselines.forecasting.windows import count_ahead, cut_windows
from mocapbench.datasets import Recording

LEARNERS = (RidgeForecast, NeighbourForecast, ProcessForecast)
PRECISE = {
    RidgeForecast: {"penalty": 1e-3},
    NeighbourForecast: {"n_neighbors": 1},
    ProcessForecast: {"noise": 1e-4},
}


def waves(name, phase, n=60, step=0.3):
    times = np.arange(n, dtype=float)
    angle = step * times + phase
    values = np.column_stack([np.sin(angle), np.cos(angle), 2.0 + np.sin(2 * angle)])
    return Recording(name, times, values, ("a.x", "a.y", "a.z"), ("cm",) * 3)


TRAINING = [waves(str(phase), phase) for phase in (0.0, 0.7, 1.9, 3.1)]
NEW = waves("new", 2.4, n=14)
GIVEN = NEW.hide((np.arange(14) > 8)[:, None])


@pytest.mark.parametrize("model", LEARNERS)
def test_a_motion_like_those_learnt_from_is_continued(model):
    fitted = model(n_seen=4, n_ahead=5, **PRECISE[model]).fit(TRAINING)
    (prediction,) = fitted.impute([GIVEN])
    hold = np.abs(NEW.values[9:] - NEW.values[8]).max()
    assert np.abs(prediction.mean - NEW.values).max() < 0.15 * hold
    np.testing.assert_array_equal(prediction.mean[:9], NEW.values[:9])


@pytest.mark.parametrize("model", LEARNERS)
def test_fewer_frames_than_it_can_predict_are_the_first_of_them(model):
    fitted = model(n_seen=4, n_ahead=5).fit(TRAINING)
    short = NEW.frames(np.arange(11)).hide((np.arange(11) > 8)[:, None])
    few, all_of_them = fitted.impute([short, GIVEN])
    np.testing.assert_allclose(few.mean, all_of_them.mean[:11])


@pytest.mark.parametrize("model", LEARNERS)
def test_only_the_last_frames_seen_count(model):
    fitted = model(n_seen=4, n_ahead=5).fit(TRAINING)
    later = GIVEN.frames(np.arange(5, 14))
    one, other = (fitted.impute([given])[0].mean for given in (GIVEN, later))
    np.testing.assert_allclose(one[5:], other)


@pytest.mark.parametrize("model", LEARNERS)
def test_the_order_of_recordings_means_nothing(model):
    one, other = (
        model(n_seen=4, n_ahead=5).fit(order).impute([GIVEN])[0].mean
        for order in (TRAINING, TRAINING[::-1])
    )
    np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("model", LEARNERS)
@pytest.mark.parametrize(
    ("hidden", "message"),
    [
        (
            np.arange(14) > 7,
            "expected 4 visible frames or more and up to 5 hidden ones, got 8 and 6",
        ),
        (np.arange(14) > 2, "got 3 and 11"),
        ((np.arange(14) > 5) & (np.arange(14) < 8), "expected visible frames and then hidden ones"),
        (np.arange(14) >= 0, "expected visible frames and then hidden ones"),
    ],
)
def test_a_recording_that_cannot_be_continued_is_named(model, hidden, message):
    fitted = model(n_seen=4, n_ahead=5).fit(TRAINING)
    with pytest.raises(ValueError, match=f"'new': .*{message}"):
        fitted.impute([NEW.hide(hidden[:, None])])


@pytest.mark.parametrize("model", LEARNERS)
def test_recordings_shorter_than_a_window_teach_nothing(model):
    with pytest.raises(ValueError, match=r"expected 70 frames in a row .* got none"):
        model(n_seen=10, n_ahead=60).fit(TRAINING)


def test_windows_are_all_runs_of_complete_frames():
    broken = TRAINING[0].hide((np.arange(60) == 20)[:, None])
    windows = cut_windows([broken, TRAINING[1]], 10)
    assert windows.shape == (20 - 9 + 39 - 9 + 60 - 9, 10, 3)
    np.testing.assert_array_equal(windows[0], broken.values[:10])
    np.testing.assert_array_equal(windows[11], broken.values[21:31])


def test_a_constant_velocity_follows_the_last_step():
    (prediction,) = ConstantVelocity().fit(TRAINING).impute([GIVEN])
    step = NEW.values[8] - NEW.values[7]
    np.testing.assert_allclose(prediction.mean[9:], NEW.values[8] + np.outer(np.arange(1, 6), step))


def test_one_visible_frame_is_held():
    one = NEW.hide((np.arange(14) > 0)[:, None])
    (prediction,) = ConstantVelocity().fit(TRAINING).impute([one])
    np.testing.assert_array_equal(prediction.mean, np.tile(NEW.values[0], (14, 1)))


def test_what_is_complete_has_nothing_ahead():
    assert count_ahead(NEW) == 0
    np.testing.assert_array_equal(ConstantVelocity().fit([NEW]).impute([NEW])[0].mean, NEW.values)


def test_neighbours_are_averaged_relative_to_a_step_that_dies_away():
    line = Recording("line", np.arange(20.0), np.arange(20.0)[:, None], ("x",), ("cm",))
    model = NeighbourForecast(n_seen=2, n_ahead=3, n_neighbors=5, damping=0.5).fit([line])
    given = line.frames(np.arange(8)).hide((np.arange(8) > 4)[:, None])
    np.testing.assert_allclose(model.impute([given])[0].mean[:, 0], np.arange(8.0))
