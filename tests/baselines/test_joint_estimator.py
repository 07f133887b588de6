"""The joint posterior of a recording, in the outputs' own units."""

import numpy as np
import pytest

from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.hgp import HGP
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import ToyProcess

MODELS = (MOHGP, MOA, LMCIndependent, GPIndependent, HGP)
TIMES = np.linspace(0.0, 5.0, 8)
OFF = np.array([4.1, 0.3, 0.3])


@pytest.fixture(scope="module")
def recordings():
    """Two complete children and two that show the same half, one output in other units."""
    rng = np.random.default_rng(0)
    children = ToyProcess.random(rng, n_outputs=2, noise=0.01).draw(rng, TIMES, 4)
    scaled = [child.with_values(child.values * [30.0, 1.0] - 7.0) for child in children]
    hidden = rng.random((8, 2)) < 0.5
    return (*scaled[:2], *(child.hide(hidden) for child in scaled[2:]))


@pytest.fixture(scope="module", params=MODELS)
def fitted(request, recordings):
    return request.param(max_iter=15).fit(recordings)


def noises(model):
    """The noise variance of each output, whether one model has them all or each its own."""
    models = getattr(model, "models_", [model])
    return np.concatenate([one.noise_ for one in models])


def test_the_diagonal_is_the_variance_of_the_imputation(fitted, recordings):
    for recording in recordings[2:]:
        (prediction,) = fitted.impute([recording])
        diagonal = np.diagonal(fitted.posterior_covariance(recording)).reshape(2, 8).T
        hidden = ~recording.visible
        variance = (diagonal + noises(fitted))[hidden]
        np.testing.assert_allclose(variance, prediction.variance[hidden], rtol=1e-8)


def test_draws_have_the_moments_of_the_posterior(fitted, recordings):
    n_samples, recording = 10_000, recordings[3]
    draws = fitted.posterior_draws(recording, n_samples, 0)
    assert draws.shape == (n_samples, 8, 2)
    flat = draws.transpose(0, 2, 1).reshape(n_samples, -1)
    covariance = fitted.posterior_covariance(recording)
    variances = np.diagonal(covariance)
    # Five standard errors: √(v / n) of a mean, at most √(2 v w / n) of a covariance.
    (prediction,) = fitted.impute([recording])
    hidden = ~recording.visible.T.ravel()
    error = np.abs(flat.mean(axis=0) - prediction.mean.T.ravel())
    assert (error < 5 * np.sqrt(variances / n_samples))[hidden].all()
    bound = 5 * np.sqrt(2.0 * np.outer(variances, variances) / n_samples)
    assert (np.abs(np.cov(flat.T) - covariance) < bound).all()


def test_times_are_the_recordings_own_unless_given(fitted, recordings):
    recording = recordings[2]
    for own, given in (
        (fitted.posterior_covariance(recording), fitted.posterior_covariance(recording, TIMES)),
        (
            fitted.posterior_draws(recording, 3, 5),
            fitted.posterior_draws(recording, 3, np.random.default_rng(5), list(TIMES)),
        ),
    ):
        np.testing.assert_array_equal(own, given)
    covariance = fitted.posterior_covariance(recording, OFF)
    np.testing.assert_array_equal(covariance, covariance.T)
    np.testing.assert_allclose(covariance[1], covariance[2], rtol=1e-9)
    draws = fitted.posterior_draws(recording, 3, 5, OFF)
    assert draws.shape == (3, 3, 2)
    np.testing.assert_allclose(draws[:, 1], draws[:, 2], rtol=1e-9)


def test_only_what_fit_has_seen_has_a_posterior(fitted, recordings):
    other = recordings[2].with_values(recordings[2].values + 1.0)
    with pytest.raises(ValueError, match="differs from the one"):
        fitted.posterior_covariance(other)
    with pytest.raises(ValueError, match="differs from the one"):
        fitted.posterior_draws(other, 1, 0)


WRONG = {
    "n_samples": ((0, 0), "expected n_samples to be an integer of at least 1, got 0"),
    "random_state": ((1, "x"), "expected random_state to be None, .*, got 'x'"),
}


@pytest.mark.parametrize(("draw", "message"), WRONG.values(), ids=WRONG)
def test_wrong_draws_are_refused(fitted, recordings, draw, message):
    with pytest.raises(ValueError, match=message):
        fitted.posterior_draws(recordings[0], *draw)


def test_a_posterior_is_that_of_a_recording_of_the_channels_of_fit(fitted, recordings):
    swapped = recordings[0].select(recordings[0].channels[::-1])
    for given, message in (("r0", "expected a sequence of Recordings"), (swapped, "channels")):
        with pytest.raises(ValueError, match=message):
            fitted.posterior_covariance(given)
        with pytest.raises(ValueError, match=message):
            fitted.posterior_draws(given, 1, 0)


@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_the_trend_to_sample_around_is_checked_when_it_is_set_after_fit(model, recordings):
    fitted = model(max_iter=2).fit(recordings).set_params(sampled_trend="x")
    with pytest.raises(ValueError, match=r"expected sampled_trend to be one of .*, got 'x'"):
        fitted.sample(OFF, 1, 0)
