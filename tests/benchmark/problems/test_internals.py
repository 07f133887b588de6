import numpy as np
import pytest

from mocapbench.baselines import MOHGP, Oracle, Trivial
from mocapbench.benchmark import Internals
from mocapbench.benchmark.problems.arrays import with_numbers
from mocapbench.benchmark.problems.internals import internals_of


@pytest.fixture(scope="module")
def toy(posed):
    return posed("toy-interpolation-3", "test 4")


def test_a_model_with_a_trend_and_matrices_leaves_both(toy):
    model = MOHGP(n_components=2, kernel="rbf", max_iter=3).fit(toy.train)
    internals = internals_of(model, toy.train)
    mean, variance = model.trend(toy.train[0].times)
    np.testing.assert_array_equal(internals.trend["trend-times"], toy.train[0].times)
    np.testing.assert_array_equal(internals.trend["trend-mean"], mean)
    np.testing.assert_array_equal(internals.trend["trend-variance"], variance)
    assert set(internals.coregionalisation) == {"parent", "child"}
    for layer, matrices in internals.coregionalisation.items():
        np.testing.assert_array_equal(matrices, model.coregionalisation_[layer])


def test_a_model_leaves_what_it_has_and_no_more(toy):
    oracle = Oracle().fit(toy.train, toy.process)
    arrays = internals_of(oracle, toy.train).to_arrays()
    assert set(arrays) == {"trend-times", "trend-mean", "trend-variance"}
    assert internals_of(Trivial().fit(toy.train), toy.train).to_arrays() == {}


RNG = np.random.default_rng(0)
TREND = {f"trend-{name}": RNG.random(5) for name in ("times", "mean", "variance")}
MATRICES = {"parent": RNG.random((3, 2, 2)), "child-of": RNG.random((1, 2, 2))}
PROPERTIES = {"property-SNR(α)": np.asarray(3.5)}
SPACE = {
    **PROPERTIES,
    "property-CLS-β": np.asarray(2),
    **with_numbers("latent-path", RNG.random((11, 4, 3))),
    "latent-cloud": RNG.random((8, 4)).astype(np.float32),
}
WALKS = {
    "latent-mean": RNG.random((6, 3)),
    **with_numbers("latent-sample", RNG.random((2, 6, 3))),
    "walk-mean": RNG.random((6, 5)),
    "walk-sample": RNG.random((6, 5)),
}
OF_ANSWERS = ("mean-0", "path-0", "labels", "samples", "blend", "covariance-child")


@pytest.mark.parametrize("trend", [None, TREND])
@pytest.mark.parametrize("matrices", [{}, MATRICES])
@pytest.mark.parametrize("space", [None, SPACE, PROPERTIES])
@pytest.mark.parametrize("walks", [None, WALKS])
def test_they_survive_the_store_beside_any_answer(survives, trend, matrices, space, walks):
    other = dict.fromkeys(OF_ANSWERS, np.zeros(3))
    internals = Internals(trend, matrices, space, walks)
    assert survives(internals, Internals.to_arrays, Internals.from_arrays, other)
