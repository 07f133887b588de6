import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from samples import recording
from scipy.stats import multivariate_normal

from mocapbench.baselines import LowRank

N_FRAMES, N_CHANNELS = 60, 4


def motion(name, seed, *, noise=0.1, offset=0.0):
    """Return a motion that two movements drive in all channels, with noise."""
    rng = np.random.default_rng(seed)
    loadings = np.random.default_rng(9).normal(size=(2, N_CHANNELS))
    values = rng.standard_normal((N_FRAMES, 2)) @ loadings
    return recording(name, values + noise * rng.standard_normal((N_FRAMES, N_CHANNELS)) + offset)


def scattered(name, seed, share=0.4):
    hidden = np.random.default_rng(seed + 100).random((N_FRAMES, N_CHANNELS)) < share
    return motion(name, seed).hide(hidden)


def fitted(*recordings, **parameters):
    return LowRank(**parameters).fit(recordings)


def covariance(model):
    noise = model.noise_variance_ * np.eye(N_CHANNELS)
    return model.loadings_ @ model.loadings_.T + noise


def test_the_objective_is_the_likelihood_of_the_visible_entries_and_the_prior():
    given = scattered("r", 1)
    model = fitted(given)
    assert model.loadings_.shape[1] == 2
    expected = 0.0
    for frame in model.own_means_.apply(given):
        seen = ~np.isnan(frame)
        block = covariance(model)[np.ix_(seen, seen)]
        expected += multivariate_normal(cov=block).logpdf(frame[seen]) if seen.any() else 0.0
    prior = -0.5 * (np.log(model.noise_variance_) + 0.05 / model.noise_variance_)
    assert model.objective_[-1] == pytest.approx(expected + prior)


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 999),
    share=st.floats(0.0, 0.9),
    explained_variance=st.sampled_from([0.3, 0.9, 1.0]),
)
@example(seed=194, share=0.890625, explained_variance=0.9)  # c3 is visible once
def test_the_objective_never_falls_but_a_channel_that_is_seen_once_is_refused(
    seed, share, explained_variance
):
    given = scattered("r", seed, share)
    model = LowRank(explained_variance=explained_variance, tol=1e-9)
    if 1 in given.visible.sum(axis=0):
        with pytest.raises(ValueError, match="expected at least two visible entries"):
            model.fit([given])
    else:
        assert (np.diff(model.fit([given]).objective_) >= -1e-8).all()


def test_complete_frames_have_their_maximum_in_closed_form():
    model = fitted(motion("r", 1))
    assert (model.n_iterations_, model.converged_) == (1, True)
    eigenvalues = np.linalg.eigvalsh(np.corrcoef(motion("r", 1).values.T))
    most_probable = (N_FRAMES * eigenvalues[:2].sum() + 0.05) / (N_FRAMES * 2 + 1)
    assert model.noise_variance_ == pytest.approx(most_probable)
    assert model.objective_[1] == pytest.approx(model.objective_[0])


@pytest.mark.parametrize("seed", [1, 4, 20, 26])
def test_channels_that_are_seldom_visible_together_do_not_make_it_certain(seed):
    """By likelihood alone the noise vanishes, and squared errors reach a million variances."""
    rng = np.random.default_rng(seed)
    truth = recording("r", rng.standard_normal((150, 3)).cumsum(axis=0))
    given = truth.hide(rng.random((150, 3)) >= 0.15)
    (prediction,) = fitted(given).impute([given])
    hidden = ~given.visible
    squares = (prediction.mean - truth.values)[hidden] ** 2 / prediction.variance[hidden]
    assert squares.max() < 1000.0


def test_predictions_are_conditional_gaussians():
    given = scattered("r", 1)
    model = fitted(given, motion("other", 2))
    (prediction,) = model.impute([given])
    own_mean, scale = np.nanmean(given.values, axis=0), model.own_means_.scale
    for n in np.flatnonzero(~given.visible.all(axis=1)):
        seen = given.visible[n]
        full = covariance(model)
        gain = full[np.ix_(~seen, seen)] @ np.linalg.inv(full[np.ix_(seen, seen)])
        mean = gain @ ((given.values[n] - own_mean) / scale)[seen]
        variance = np.diag(full[np.ix_(~seen, ~seen)] - gain @ full[np.ix_(seen, ~seen)])
        np.testing.assert_allclose(
            prediction.mean[n, ~seen], own_mean[~seen] + scale[~seen] * mean, atol=1e-9
        )
        np.testing.assert_allclose(prediction.variance[n, ~seen], scale[~seen] ** 2 * variance)


def test_channels_that_follow_others_are_filled_without_a_complete_frame():
    """Every fourth frame of a channel is hidden; the cycles have ten frames, so means are known."""
    frames = np.arange(N_FRAMES)
    angle = 2 * np.pi * frames / 10
    loadings = np.random.default_rng(9).normal(size=(2, N_CHANNELS))
    truth = recording("r", np.column_stack([np.sin(angle), np.cos(2 * angle)]) @ loadings)
    given = truth.hide(frames[:, None] % N_CHANNELS == np.arange(N_CHANNELS))
    assert not given.visible.all(axis=1).any()
    filled = fitted(given, explained_variance=0.9).impute([given])[0].mean
    np.testing.assert_allclose(filled, truth.values, atol=0.01)


def test_frames_hidden_as_a_whole_take_the_recordings_own_mean_and_all_the_variance():
    gap = np.repeat((np.arange(N_FRAMES) // 10 == 2)[:, None], N_CHANNELS, axis=1)
    given = motion("r", 3).hide(gap)
    model = fitted(given, motion("other", 2, offset=30.0))
    (prediction,) = model.impute([given])
    own_mean = np.nanmean(given.values, axis=0)
    np.testing.assert_allclose(prediction.mean[20:30], np.tile(own_mean, (10, 1)), atol=1e-12)
    variance = np.diag(covariance(model)) * model.own_means_.scale**2
    np.testing.assert_allclose(prediction.variance[20:30], np.tile(variance, (10, 1)))


@given(shift=st.floats(-50, 50), factor=st.floats(0.1, 10))
@settings(max_examples=10, deadline=None)
def test_predictions_follow_a_change_of_units(shift, factor):
    given = scattered("r", 1)
    changed = given.with_values(factor * given.values + shift)
    one, other = (fitted(each).impute([each])[0] for each in (given, changed))
    np.testing.assert_allclose(other.mean, factor * one.mean + shift, atol=1e-6)
    np.testing.assert_allclose(other.variance, factor**2 * one.variance, rtol=1e-6)


def test_loadings_need_ten_visible_entries_each():
    sparse = scattered("r", 1, share=0.0).frames(np.arange(9))
    assert fitted(sparse).loadings_.shape == (N_CHANNELS, 0)
    assert fitted(motion("r", 1).frames(np.arange(10))).loadings_.shape == (N_CHANNELS, 1)


def test_hardships_have_a_sensible_result():
    constant = recording("constant", np.tile(np.arange(4.0), (N_FRAMES, 1)))
    gap = np.outer(np.arange(N_FRAMES) < 9, np.arange(N_CHANNELS) == 1)
    filled = fitted(constant).impute([constant.hide(gap)])[0].mean
    np.testing.assert_allclose(filled, constant.values)
    one_frame = recording("one", np.array([[1.0, np.nan, 2.0, 3.0]]))
    filled = fitted(motion("other", 2, offset=4.0), one_frame).impute([one_frame])[0].mean
    assert filled[0, 1] == pytest.approx(motion("other", 2, offset=4.0).values[:, 1].mean())
    single = recording("single", np.array([[1.0], [np.nan], [3.0]]))
    assert fitted(single).impute([single])[0].mean[1, 0] == pytest.approx(2.0)


def test_a_channel_never_visible_in_training_takes_its_own_mean():
    unseen = motion("train", 2).hide(np.tile(np.arange(N_CHANNELS) == 1, (N_FRAMES, 1)))
    gap = np.outer(np.arange(N_FRAMES) < 9, np.arange(N_CHANNELS) == 1)
    given = motion("r", 3).hide(gap)
    model = fitted(unseen)
    filled = model.impute([given])[0].mean[:9, 1]
    np.testing.assert_allclose(filled, np.nanmean(given.values[:, 1]))
    with pytest.raises(ValueError, match=r"'train': expected a visible .* got none of \['c1'\]"):
        model.impute([unseen])


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"explained_variance": 2.0}, "expected explained_variance to be a number from 0 to 1"),
        ({"max_iter": 0}, "expected max_iter to be an integer of at least 1, got 0"),
        ({"tol": -1.0}, "expected tol to be a finite positive number, got -1.0"),
    ],
)
def test_parameters_out_of_range_are_refused(parameters, message):
    with pytest.raises(ValueError, match=message):
        fitted(motion("r", 1), **parameters)
