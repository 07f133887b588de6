import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging.paths import doubt_about_path, explained_share, weigh_paths


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_weights_sum_to_one_and_the_best_path_has_the_largest(seed, n_paths):
    errors = np.random.default_rng(seed).gamma(1.0, size=n_paths)
    weights = weigh_paths(errors)
    assert weights.sum() == pytest.approx(1.0)
    assert weights.argmax() == errors.argmin()


def test_paths_that_predict_alike_leave_no_doubt():
    alike, weights = np.ones((3, 6, 2)), weigh_paths(np.array([1.0, 2.0, 5.0]))
    np.testing.assert_allclose(doubt_about_path(alike, weights), 0.0, atol=1e-30)


def test_one_path_says_nothing_of_others():
    np.testing.assert_array_equal(doubt_about_path(np.ones((1, 6, 2)), np.ones(1)), 0.0)


def test_the_doubt_is_that_of_one_more_draw():
    """With equal weights it is the sample variance times 1 + 1/K, without bias."""
    rng = np.random.default_rng(0)
    doubt = doubt_about_path(rng.normal(size=(4, 50_000, 1)), np.full(4, 0.25))
    assert doubt.mean() == pytest.approx(1.25, rel=0.02)


@pytest.mark.parametrize(
    ("errors", "total", "explained"),
    [([2.0, 5.0], 10.0, 0.8), ([20.0, 30.0], 10.0, -1.0), ([0.0], 0.0, 1.0), ([1.0], 0.0, -np.inf)],
)
def test_the_share_explained_is_that_of_the_best_path(errors, total, explained):
    assert explained_share(np.array(errors), total) == pytest.approx(explained)


def test_an_exact_path_has_all_the_weight():
    with np.errstate(all="raise", under="ignore"):
        np.testing.assert_array_equal(weigh_paths(np.array([0.0, 5.0])), [1.0, 0.0])
