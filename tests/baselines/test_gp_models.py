"""What the Gaussian-process models have in common."""

import numpy as np
import pytest
from sklearn.base import clone

from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.hgp import HGP
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import ToyProcess

MODELS = (MOHGP, MOA, LMCIndependent, GPIndependent, HGP)
JOINT = (MOHGP, MOA, LMCIndependent)
TIMES = np.linspace(0.0, 5.0, 12)


@pytest.fixture(scope="module")
def recordings():
    rng = np.random.default_rng(0)
    children = ToyProcess.random(rng, n_outputs=2, noise=0.01).draw(rng, TIMES, 3)
    return (*children[:2], children[2].hide(rng.random((12, 2)) < 0.6))


@pytest.fixture(scope="module", params=MODELS)
def fitted(request, recordings):
    return request.param(max_iter=60).fit(recordings)


def test_predictions_carry_the_visible_entries_and_noise(fitted, recordings):
    for recording, prediction in zip(recordings, fitted.impute(recordings), strict=True):
        visible = recording.visible
        np.testing.assert_array_equal(prediction.mean[visible], recording.values[visible])
        assert (prediction.variance[visible] == 0.0).all()
        assert (prediction.variance[~visible] > 0.0).all()


def test_only_what_fit_has_seen_is_imputed(fitted, recordings):
    with pytest.raises(ValueError, match="give it to fit"):
        fitted.impute(
            [
                ToyProcess.random(np.random.default_rng(1), n_outputs=2, noise=0.1)
                .draw(np.random.default_rng(1), TIMES, 9)[8]
                .select(recordings[0].channels)
            ]
        )
    with pytest.raises(ValueError, match="differs from the one"):
        fitted.impute([recordings[2].with_values(recordings[2].values + 1.0)])


@pytest.mark.parametrize("model", MODELS)
def test_fit_keeps_the_constructor_parameters(model, recordings):
    estimator = model(kernel="matern52", max_iter=3)
    before = estimator.get_params()
    assert estimator.fit(recordings).get_params() == before
    assert clone(estimator).get_params() == before


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"kernel": "linear"}, "matern32"),
        ({"solver": "magic"}, "latent-split"),
        ({"n_components": 0}, "n_components"),
        ({"n_restarts": 0}, "n_restarts"),
        ({"max_iter": 0}, "max_iter"),
        ({"max_iter": 1.5}, "max_iter"),
        ({"tol": 0.0}, "tol"),
        ({"tol": float("nan")}, "tol"),
        ({"max_seconds": -1.0}, "max_seconds"),
        ({"max_seconds": "long"}, "max_seconds"),
        ({"random_state": "q"}, "random_state to be None, an integer"),
        ({"random_state": -1}, "random_state to be None, an integer"),
        ({"n_components": {"grandchild": 1}}, "for each of the layers"),
        ({"n_components": {}}, "for each of the layers"),
        ({"n_components": {"parent": 1, "child": 1, "pet": 1}}, "for each of the layers"),
    ],
)
def test_parameters_are_validated_in_fit(model, wrong, message, recordings):
    with pytest.raises(ValueError, match=message):
        model(**wrong).fit(recordings)


@pytest.mark.parametrize("model", MODELS)
def test_recordings_are_validated_in_fit(model, recordings):
    with pytest.raises(ValueError, match="at least one"):
        model().fit([])
    with pytest.raises(ValueError, match="distinct names"):
        model().fit([recordings[0], recordings[0]])
    with pytest.raises(ValueError, match="visible entry"):
        model().fit([r.hide(np.tile([True, False], (12, 1))) for r in recordings])


@pytest.mark.parametrize("model", MODELS)
def test_rescaling_an_output_shifts_the_log_likelihood_by_its_jacobian(model, recordings):
    factor = np.array([40.0, 1.0])
    scaled = [r.with_values(r.values * factor - 7.0) for r in recordings]
    one, two = (model(max_iter=5).fit(data) for data in (recordings, scaled))
    n_first = sum(int(r.visible[:, 0].sum()) for r in recordings)
    expected = one.log_likelihood_ - n_first * np.log(40.0)
    assert two.log_likelihood_ == pytest.approx(expected, rel=1e-6)
    for a, b in zip(one.impute(recordings), two.impute(scaled), strict=True):
        np.testing.assert_allclose(b.mean, a.mean * factor - 7.0, rtol=1e-4, atol=1e-4)
        np.testing.assert_allclose(b.variance, a.variance * factor**2, rtol=1e-4)


@pytest.mark.parametrize("model", JOINT)
def test_solvers_predict_alike(model, recordings):
    dense, split = (
        model(max_iter=4, solver=name).fit(recordings) for name in ("dense", "latent-split")
    )
    assert (dense.solver_, split.solver_) == ("dense", "latent-split")
    assert dense.log_likelihood_ == pytest.approx(split.log_likelihood_, rel=1e-6)
    for a, b in zip(dense.impute(recordings), split.impute(recordings), strict=True):
        np.testing.assert_allclose(a.mean, b.mean, rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(a.variance, b.variance, rtol=1e-5, atol=1e-7)


@pytest.mark.parametrize("model", JOINT)
def test_restarts_are_seeded_and_never_worse(model, recordings):
    one = model(max_iter=30, n_restarts=1, n_components=3).fit(recordings)
    many, again = (
        model(max_iter=30, n_restarts=7, n_components=3, random_state=5).fit(recordings)
        for _ in range(2)
    )
    assert len(many.training_) == 7
    assert many.log_likelihood_ >= one.log_likelihood_
    assert many.log_likelihood_ == again.log_likelihood_


@pytest.mark.parametrize("model", JOINT)
def test_covariances_are_positive_semi_definite(model, recordings):
    fitted = model(n_components=2, max_iter=10).fit(recordings)
    for layer in fitted.layers:
        covariance = fitted.covariance(layer, TIMES)
        assert np.linalg.eigvalsh(covariance).min() > -1e-10 * np.trace(covariance)
        total = fitted.coregionalisation_[layer].sum(axis=0)
        np.testing.assert_allclose(
            np.diagonal(covariance), np.repeat(np.diagonal(total), 12), rtol=1e-12
        )


@pytest.mark.parametrize("model", JOINT)
def test_samples_have_the_moments_of_a_new_recording(model, recordings):
    fitted = model(max_iter=30).fit(recordings)
    times = np.array([0.4, 2.0, 4.7])
    n_samples = 20_000
    samples = fitted.sample(times, n_samples, 0)
    ((trend, _),) = fitted.process_.infer([fitted.process_.reduction.trend], [times])
    covariance = fitted.covariance(fitted.layers[-1], times)
    expected = np.diagonal(covariance).reshape(2, 3).T + fitted.noise_
    # Five standard errors of a mean, and of a variance.
    assert (np.abs(samples.mean(axis=0) - trend) < 5 * np.sqrt(expected / n_samples)).all()
    assert (np.abs(samples.var(axis=0) / expected - 1.0) < 5 * np.sqrt(2 / n_samples)).all()


@pytest.mark.parametrize("model", MODELS)
def test_constant_outputs_do_no_harm(model, recordings):
    constant = [
        r.with_values(np.column_stack([r.values[:, 0], 0.0 * TIMES + 0.1])) for r in recordings
    ]
    for prediction in model(max_iter=40).fit(constant).impute(constant):
        np.testing.assert_allclose(prediction.mean[:, 1], 0.1, atol=1e-3)


@pytest.mark.parametrize("model", JOINT)
def test_every_layer_may_have_its_own_number_of_components(model, recordings):
    layers = model(max_iter=1).fit(recordings).layers
    sizes = {name: size for name, size in {"parent": 3, "child": 1}.items() if name in layers}
    fitted = model(n_components=sizes, max_iter=10).fit(recordings)
    assert {name: len(b) for name, b in fitted.coregionalisation_.items()} == sizes
    for name, size in sizes.items():
        with pytest.raises(ValueError, match=f"n_components of '{name}'"):
            model(n_components=sizes | {name: 0 * size}).fit(recordings)


@pytest.mark.parametrize("model", MODELS)
def test_a_warm_start_goes_on_where_the_last_fit_ended(model, recordings):
    estimator = model(max_iter=4, warm_start=True).fit(recordings)
    first = estimator.log_likelihood_
    assert not estimator.converged_
    assert estimator.fit(recordings).log_likelihood_ > first
    cold = model(max_iter=4).fit(recordings)
    assert cold.fit(recordings).log_likelihood_ == pytest.approx(first, rel=1e-12)


@pytest.mark.parametrize("model", MODELS)
def test_a_warm_start_needs_parameters_of_the_same_shapes(model, recordings):
    estimator = model(max_iter=2, warm_start=True).fit(recordings)
    with pytest.raises(ValueError, match="warm_start=False"):
        estimator.set_params(n_components=2).fit(recordings)


@pytest.mark.parametrize("model", MODELS)
def test_spent_time_ends_the_fit(model, recordings):
    fitted = model(max_seconds=1e-9, n_restarts=3).fit(recordings)
    assert not fitted.converged_
    assert fitted.n_evaluations_ < 10
    assert np.isfinite(fitted.log_likelihood_)


def test_a_verbose_fit_prints_a_line_for_every_iteration(recordings, capsys):
    fitted = MOHGP(max_iter=3, n_restarts=2, verbose=True).fit(recordings)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == sum(search.n_iterations for search in fitted.training_)
    assert lines[0].startswith("search 1 of 2, iteration 1: log-likelihood ")
    assert lines[-1].startswith("search 2 of 2, iteration ")
    printed = float(lines[-1].partition("log-likelihood ")[2].partition(",")[0])
    last = fitted.training_[-1].log_likelihood + fitted.scaling_.log_jacobian
    assert printed == pytest.approx(last, abs=1e-3)


@pytest.mark.parametrize("model", JOINT)
def test_the_criterion_of_schwarz_charges_every_parameter(model, recordings):
    fitted = model(max_iter=3).fit(recordings)
    visible = sum(int(recording.visible.sum()) for recording in recordings)
    expected = fitted.parameters_.flat.size * np.log(visible) - 2.0 * fitted.log_likelihood_
    assert fitted.bic_ == pytest.approx(expected, rel=1e-12)
