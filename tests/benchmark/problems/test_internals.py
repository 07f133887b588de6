import numpy as np
import pytest

from mocapbench.baselines import MOHGP, Oracle, Trivial
from mocapbench.benchmark.problems.arrays import with_prefix
from mocapbench.benchmark.problems.internals import internals_of


@pytest.fixture(scope="module")
def toy(posed):
    return posed("toy-interpolation-3", "test 4")


def test_a_model_with_a_trend_and_matrices_leaves_both(toy):
    model = MOHGP(n_components=2, kernel="rbf", max_iter=3).fit(toy.train)
    internals = internals_of(model, toy.train)
    mean, variance = model.trend(toy.train[0].times)
    np.testing.assert_array_equal(internals["trend-times"], toy.train[0].times)
    np.testing.assert_array_equal(internals["trend-mean"], mean)
    np.testing.assert_array_equal(internals["trend-variance"], variance)
    layers = with_prefix("coregionalisation", internals)
    assert set(layers) == {"parent", "child"}
    for layer, matrices in layers.items():
        np.testing.assert_array_equal(matrices, model.coregionalisation_[layer])


def test_a_model_leaves_what_it_has_and_no_more(toy):
    oracle = Oracle().fit(toy.train, toy.process)
    arrays = internals_of(oracle, toy.train)
    assert set(arrays) == {"trend-times", "trend-mean", "trend-variance"}
    assert internals_of(Trivial().fit(toy.train), toy.train) == {}
