import joblib
import numpy as np
import pytest

from mocapbench.baselines.gp.solvers.latent_split.split_solver import LatentSplit
from mocapbench.baselines.gp.solvers.solver import thread_mapper
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording


@pytest.mark.parametrize("n_threads", [1, 2, 3])
def test_results_come_in_order(n_threads):
    with thread_mapper(n_threads) as mapper:
        assert list(mapper(lambda x: x * x, range(20))) == [x * x for x in range(20)]


def test_the_likelihood_does_not_depend_on_the_number_of_threads(case):
    example = case(
        np.random.default_rng(0), n_outputs=12, n_times=40, n_replicates=4, masks="mixed"
    )
    results = []
    for n_threads in (1, 2, 4):
        with thread_mapper(n_threads) as mapper:
            solvers = [LatentSplit(example.kernel, mapper)] * len(example.reduction.blocks)
            results.append(example.reduction.evaluate(solvers, example.parameters))
    for value, gradient in results[1:]:
        assert value == pytest.approx(results[0][0], rel=1e-10)
        np.testing.assert_allclose(gradient, results[0][1], rtol=1e-10, atol=1e-10)


def test_fits_do_not_depend_on_the_number_of_threads_which_joblib_may_set():
    rng = np.random.default_rng(1)
    channels = tuple("abcdefgh")
    recordings = [
        Recording(name, np.arange(12.0), rng.standard_normal((12, 8)), channels, ("none",) * 8)
        for name in "xyz"
    ]
    recordings[2] = recordings[2].hide(rng.random((12, 8)) < 0.5)
    settings = {"max_iter": 5, "solver": "latent-split"}
    one = MOHGP(**settings).fit(recordings)
    two = MOHGP(**settings, n_jobs=2).fit(recordings)
    with joblib.parallel_config(backend="threading", n_jobs=2):
        three = MOHGP(**settings).fit(recordings)
        predicted = three.impute(recordings[2:])
    for other in (two, three):
        np.testing.assert_allclose(other.parameters_.flat, one.parameters_.flat, rtol=1e-10)
    np.testing.assert_allclose(predicted[0].mean, one.impute(recordings[2:])[0].mean, rtol=1e-10)
