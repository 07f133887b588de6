from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.oracle import Oracle
from mocapbench.datasets import ToyProcess

TIMES = np.linspace(0.0, 2.0 * np.pi, 50)


def _problem(seed, noise):
    rng = np.random.default_rng([seed, int(1000 * noise)])
    process = ToyProcess.random(rng, n_outputs=3, noise=noise)
    *others, child = process.draw(rng, TIMES, 5)
    hidden = np.ones((50, 3), dtype=bool)
    for column in hidden.T:
        column[rng.choice(50, 5, replace=False)] = False
    return process, (*others, child.hide(hidden)), child.values, hidden


def _pooled_error(model, recordings, truth, hidden, **given):
    (prediction,) = model.fit(recordings, **given).impute(recordings[-1:])
    return np.mean((prediction.mean - truth)[hidden] ** 2) / truth[hidden].var()


def test_the_trend_passes_through_children_that_agree():
    rng = np.random.default_rng(0)
    (child,) = ToyProcess.random(rng, n_outputs=2, noise=1e-4).draw(rng, TIMES[::2], 1)
    copies = [replace(child, name=f"copy-{r}") for r in range(4)]
    mean, variance = MOHGP(kernel="rbf").fit(copies).trend(child.times)
    np.testing.assert_allclose(mean, child.values, atol=0.05)
    assert (variance >= 0.0).all()


def test_a_hidden_recording_is_predicted_by_the_trend_and_a_new_child():
    _, recordings, _, _ = _problem(1, 0.01)
    hidden = recordings[0].hide(np.ones((50, 3), dtype=bool))
    model = MOHGP(n_components=2, kernel="rbf", max_iter=40).fit((hidden, *recordings[1:]))
    (prediction,) = model.impute([hidden])
    mean, variance = model.trend(TIMES)
    child = np.diagonal(model.covariance("child", TIMES)).reshape(3, 50).T
    np.testing.assert_allclose(prediction.mean, mean, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(prediction.variance, variance + child + model.noise_, rtol=1e-8)


@pytest.mark.slow
def test_it_comes_close_to_the_true_parameters_on_toy_data():
    """Pooled SMSE within a quarter of the oracle's, by the mean over noises of fold means."""
    ratios = []
    for noise in (0.001, 0.01, 0.1):
        ours, limit = [], []
        for seed in range(20):
            process, *problem = _problem(seed, noise)
            model = MOHGP(n_components=3, kernel="rbf", n_restarts=2)
            ours.append(_pooled_error(model, *problem))
            limit.append(_pooled_error(Oracle(), *problem, process=process))
        ratios.append(np.mean(ours) / np.mean(limit))
    assert np.mean(ratios) <= 1.25


@pytest.mark.slow
def test_a_common_trend_pays_where_there_is_one():
    hierarchy, independent = 0.0, 0.0
    for seed in range(5):
        _, *problem = _problem(seed, 0.01)
        model = MOHGP(n_components=3, kernel="rbf", n_restarts=2)
        hierarchy += _pooled_error(model, *problem)
        independent += _pooled_error(LMCIndependent(n_components=3, kernel="rbf"), *problem)
    assert hierarchy < independent
