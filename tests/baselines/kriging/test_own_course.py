import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging import own_course as module
from mocapbench.baselines.kriging.conditioned import growth_of_variance
from mocapbench.baselines.kriging.own_course import own_course

VISIBLE = np.ones(40, dtype=bool)
VISIBLE[15:25] = False


def course(seed):
    return np.random.default_rng(seed).normal(size=(40, 3)).cumsum(axis=0)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 1000), st.floats(-100.0, 100.0), st.floats(0.1, 10.0))
def test_it_moves_with_the_unit(seed, shift, scale):
    values = course(seed)
    mean, variance = own_course(values, VISIBLE, 1e-12)
    there, wider = own_course(shift + scale * values, VISIBLE, 1e-12)
    np.testing.assert_allclose(there, shift + scale * mean, atol=1e-6)
    np.testing.assert_allclose(wider, scale**2 * variance, rtol=1e-6)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 1000))
def test_hidden_values_are_not_read(seed):
    values = course(seed)
    hidden = np.where(VISIBLE[:, None], values, np.nan)
    for one, other in zip(
        own_course(values, VISIBLE, 1e-12), own_course(hidden, VISIBLE, 1e-12), strict=True
    ):
        np.testing.assert_array_equal(one, other)


def test_doubt_grows_into_a_gap():
    _, variance = own_course(course(0), VISIBLE, 1e-12)
    assert (np.diff(variance[15:20], axis=0) > 0).all()
    assert (np.diff(variance[20:25], axis=0) < 0).all()


def test_a_pose_that_never_changes_goes_on_and_has_a_variance():
    mean, variance = own_course(np.full((40, 3), 7.0), VISIBLE, 1e-9)
    np.testing.assert_allclose(mean, 7.0)
    assert (variance > 0).all()


def test_intervals_cover_what_they_claim():
    """Of random walks, whose kernel is another one."""
    inside = []
    for seed in range(100):
        values = course(seed)
        mean, variance = own_course(values, VISIBLE, 1e-12)
        inside.append(np.abs(values - mean)[~VISIBLE] < 1.96 * np.sqrt(variance[~VISIBLE]))
    assert 0.88 < np.mean(inside) < 0.98


def test_variances_grow_by_how_much_more_than_expected_copies_of_the_gaps_err(monkeypatch):
    values = np.sin(np.arange(40) / 5.0)[:, None] * [1.0, 0.5, 2.0]
    _, grown = own_course(values, VISIBLE, 1e-12)
    given = []
    monkeypatch.setattr(module, "growth_of_variance", lambda sums: given.append(sums) or 1.0)
    _, variance = own_course(values, VISIBLE, 1e-12)
    growth = growth_of_variance(given[0])
    assert growth > 1.1
    np.testing.assert_allclose(grown, growth * variance)
