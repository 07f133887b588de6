"""What all estimators of the family share, whatever prior and learning."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.model import GPDM
from mocapbench.baselines.gpdm.posterior import KAPPA
from mocapbench.baselines.gplvm import GPLVM
from mocapbench.datasets import Recording

CHANNELS = ("a", "b", "c", "still")


def walk(name, n_frames, start=0.0):
    angle = start + 0.5 * np.arange(n_frames)
    values = np.column_stack([np.sin(angle), 9 * np.cos(angle), np.sin(angle + 1), 0 * angle + 7])
    return Recording(name, np.arange(n_frames) / 30, values, CHANNELS, ("deg",) * 4)


WALKS = (walk("a", 15), walk("b", 12, 0.2))
MODELS = {
    "gpdm": GPDM(n_latent=2, max_iter=4, fill_iter=10),
    "gplvm": GPLVM(n_latent=2, max_iter=4, fill_iter=10),
}


@pytest.fixture(scope="module", params=MODELS)
def fitted(request):
    with pytest.warns(UserWarning, match="channels still"):
        return MODELS[request.param].fit(WALKS)


def test_there_is_one_latent_path_for_each_stretch(fitted):
    assert [path.shape for path in fitted.latent_paths()] == [(12, 2), (15, 2)]


def test_poses_at_training_positions_are_the_training_frames(fitted):
    for path, recording in zip(fitted.latent_paths(), fitted.recordings_, strict=True):
        errors = fitted.poses(path) - recording.values
        assert np.abs(errors / recording.values.std(axis=0).clip(min=1.0)).max() < 0.3
        np.testing.assert_array_equal(errors[:, 3], 0.0)


def test_a_shift_of_the_channels_shifts_the_fill(fitted):
    new, gap = walk("new", 12, 0.4), np.repeat((np.arange(12) // 3 == 2)[:, None], 4, axis=1)
    shift = np.array([5.0, -3.0, 0.0, 1.0])
    moved = [w.with_values(w.values + shift) for w in (*WALKS, new)]
    (prediction,) = fitted.impute([new.hide(gap)])
    with pytest.warns(UserWarning, match="channels still"):
        other = type(fitted)(**fitted.get_params()).fit(moved[:2])
    (shifted,) = other.impute([moved[2].hide(gap)])
    np.testing.assert_allclose(shifted.mean, prediction.mean + shift, atol=1e-3)
    np.testing.assert_allclose(shifted.variance, prediction.variance, rtol=1e-2)


def test_visible_entries_are_copied_and_hidden_ones_uncertain(fitted):
    new, gap = walk("new", 12, 0.4), np.repeat((np.arange(12) // 3 == 2)[:, None], 4, axis=1)
    (prediction,) = fitted.impute([new.hide(gap)])
    np.testing.assert_array_equal(prediction.mean[~gap], new.values[~gap])
    assert (prediction.variance[~gap] == 0).all()
    assert (prediction.variance[gap] > 0).all()


def test_confidence_falls_away_from_training(fitted):
    there = fitted.confidence(fitted.latent_paths()[0])
    assert there.min() > fitted.confidence(np.full((1, 2), 20.0)).item()


def test_a_constant_channel_has_the_variance_of_a_scaled_one_and_the_unit_of_the_bound(fitted):
    new, gap = walk("new", 12, 0.4), (np.arange(12) // 3 == 2)[:, None]
    (prediction,) = fitted.impute([new.hide(gap)])
    scaled = prediction.variance[:, :3] * fitted.estimate_.scales**2
    bound = 1.0 / (KAPPA**2 * sum(len(recording.times) for recording in WALKS))
    np.testing.assert_allclose(prediction.variance[:, 3], scaled[:, 0] * bound)
    np.testing.assert_allclose(scaled.T, scaled[:, [0]].T.repeat(3, axis=0))
