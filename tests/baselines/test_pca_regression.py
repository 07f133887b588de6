import numpy as np
import pytest
from samples import recording

from mocapbench.baselines import PCARegression

N_FRAMES, N_CHANNELS = 60, 6
HIDDEN = [1, 4]
VISIBLE = [0, 2, 3, 5]


def motion(name, seed, *, rank=3, offset=0.0):
    """Return a motion of six cycles in which ``rank`` movements drive all channels."""
    harmonics = np.arange(1, rank + 1)
    phases = np.random.default_rng(seed).uniform(0.0, 2 * np.pi, rank)
    movements = np.sin(2 * np.pi * np.arange(N_FRAMES)[:, None] * harmonics / 10 + phases)
    loadings = np.random.default_rng(9).normal(size=(rank, N_CHANNELS))
    return recording(name, movements @ loadings + offset)


def gap(frames, channels=HIDDEN):
    hidden = np.zeros((N_FRAMES, N_CHANNELS), dtype=bool)
    hidden[np.ix_(frames, channels)] = True
    return hidden


def fill(model, given, *others):
    return model.fit([*others, given]).impute([given])[0].mean


def principal_component_regression(complete, frame, n_components):
    """Return the hidden channels of a frame by least squares on the scores of visible channels."""
    _, _, axes = np.linalg.svd(complete[:, VISIBLE], full_matrices=False)
    axes = axes[:n_components].T
    slopes, *_ = np.linalg.lstsq(complete[:, VISIBLE] @ axes, complete[:, HIDDEN])
    return frame[VISIBLE] @ axes @ slopes


def test_with_a_small_weight_it_is_principal_component_regression():
    rng = np.random.default_rng(0)
    noisy = motion("r", 1).values + 0.3 * rng.standard_normal((N_FRAMES, N_CHANNELS))
    given = recording("r", noisy).hide(gap([7]))
    own_mean = np.nanmean(given.values, axis=0)
    z = (given.values - own_mean) / (scale := np.nanstd(given.values, axis=0))
    complete = np.delete(z, 7, axis=0)
    singular = np.linalg.svd(complete[:, VISIBLE], compute_uv=False)
    share = singular[:3].sum() / singular.sum() - 0.01  # held by three components
    expected = principal_component_regression(complete, z[7], 3)
    filled = fill(PCARegression(1e-4, share=share), given)[7, HIDDEN]
    np.testing.assert_allclose((filled - own_mean[HIDDEN]) / scale[HIDDEN], expected, rtol=1e-3)


@pytest.mark.parametrize("others", [(), (motion("other", 5),)], ids=["alone", "with another"])
def test_channels_that_follow_others_are_filled(others):
    truth = motion("r", 2)
    filled = fill(PCARegression(), truth.hide(gap(range(10, 20))), *others)
    np.testing.assert_allclose(filled, truth.values, atol=0.01)


def test_a_recording_without_a_complete_frame_is_filled_from_others():
    """One channel is hidden in every frame but the first, so that its own mean is known."""
    truth = motion("r", 2)
    given = truth.hide(gap(range(1, N_FRAMES), [1]))
    filled = fill(PCARegression(), given, motion("other", 5))
    residual = filled[1:, 1] - truth.values[1:, 1]
    assert residual.std() < 0.05 * truth.values[1:, 1].std()


def test_a_new_recording_is_filled_as_one_that_fit_has_seen():
    other, given = motion("other", 5), motion("r", 2).hide(gap(range(10, 20)))
    new = PCARegression().fit([other]).impute([given])[0].mean
    np.testing.assert_allclose(new, fill(PCARegression(), given, other), rtol=1e-12)


def test_frames_hidden_as_a_whole_take_the_recordings_own_mean():
    given = motion("r", 2).hide(gap(range(10, 20), range(N_CHANNELS)))
    filled = fill(PCARegression(), given, motion("other", 5, offset=30.0))
    own_mean = np.nanmean(given.values, axis=0)
    np.testing.assert_allclose(filled[10:20], np.tile(own_mean, (10, 1)), atol=1e-12)


def test_a_constant_offset_of_other_recordings_changes_nothing():
    given = motion("r", 2).hide(gap(range(10, 20)))
    near, far = (fill(PCARegression(), given, motion("o", 5, offset=o)) for o in (0.0, 50.0))
    np.testing.assert_allclose(near, far, atol=1e-9)


@pytest.mark.parametrize(("n_complete", "regresses"), [(9, False), (10, True)])
def test_a_component_needs_ten_complete_frames(n_complete, regresses):
    given = motion("r", 2, rank=1).hide(gap(range(n_complete, N_FRAMES)))
    filled = fill(PCARegression(), given)[n_complete:, HIDDEN]
    own_mean = np.nanmean(given.values, axis=0)[HIDDEN]
    assert (np.abs(filled - own_mean).max() > 0.1) == regresses


def test_hardships_have_a_sensible_result():
    constant = recording("constant", np.tile(np.arange(6.0), (N_FRAMES, 1)))
    filled = fill(PCARegression(), constant.hide(gap([3])))
    np.testing.assert_allclose(filled, constant.values)
    one_frame = recording("one", np.array([[1.0, np.nan, 2.0, 3.0, np.nan, 0.0]]))
    filled = fill(PCARegression(), one_frame, motion("other", 5, offset=4.0))
    np.testing.assert_allclose(filled[0, HIDDEN], 4.0)
    single = recording("single", np.array([[1.0], [np.nan], [3.0]]))
    np.testing.assert_allclose(fill(PCARegression(), single)[:, 0], [1.0, 2.0, 3.0])


def test_what_it_refuses():
    given = motion("r", 2)
    with pytest.raises(ValueError, match="expected hidden_weight to be a finite positive"):
        PCARegression(0.0).fit([given])
    with pytest.raises(ValueError, match="expected share to be a number from 0 to 1, got 99"):
        PCARegression(share=99).fit([given])
    unseen = given.hide(gap(range(N_FRAMES), [2]))
    with pytest.raises(ValueError, match=r"'r': expected a visible .* got none of \['c2'\]"):
        fill(PCARegression(), unseen)
