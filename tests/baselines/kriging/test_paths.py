import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging.paths import MatchedPaths


def paths(seed, n_paths=3, moved=10.0):
    rng = np.random.default_rng(seed)
    return MatchedPaths(rng.normal(size=(n_paths, 6, 2)), rng.gamma(1.0, size=n_paths), moved)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_weights_sum_to_one_and_the_best_path_has_the_largest(seed, n_paths):
    matched = paths(seed, n_paths)
    assert matched.weights.sum() == pytest.approx(1.0)
    assert matched.weights.argmax() == matched.errors.argmin()


def test_paths_that_predict_alike_leave_no_doubt():
    alike = np.ones((3, 6, 2))
    np.testing.assert_allclose(paths(0).doubt(alike), 0.0, atol=1e-30)


def test_one_path_says_nothing_of_others():
    np.testing.assert_array_equal(paths(0, 1).doubt(np.ones((1, 6, 2))), 0.0)


def test_the_doubt_is_that_of_one_more_draw():
    """With equal weights it is the sample variance times 1 + 1/K, without bias."""
    rng = np.random.default_rng(0)
    matched = MatchedPaths(np.zeros((4, 50_000, 1)), np.ones(4), 1.0)
    doubt = matched.doubt(rng.normal(size=(4, 50_000, 1)))
    assert doubt.mean() == pytest.approx(1.25, rel=0.02)


@pytest.mark.parametrize(
    ("errors", "moved", "explained"),
    [([2.0, 5.0], 10.0, 0.8), ([20.0, 30.0], 10.0, -1.0), ([0.0], 0.0, 1.0), ([1.0], 0.0, -np.inf)],
)
def test_the_share_explained_is_that_of_the_best_path(errors, moved, explained):
    matched = MatchedPaths(np.zeros((len(errors), 3, 1)), np.array(errors), moved)
    assert matched.explained == pytest.approx(explained)


def test_an_exact_path_has_all_the_weight():
    paths = MatchedPaths(np.zeros((2, 3, 1)), np.array([0.0, 5.0]), 1.0)
    with np.errstate(all="raise", under="ignore"):
        np.testing.assert_array_equal(paths.weights, [1.0, 0.0])
