import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import solveh_banded

from mocapbench.baselines.common.transitions import fill_gap, least_squares_path

seeds = st.integers(0, 2**32 - 1)


def gap(seed, ends, n=8):
    rng = np.random.default_rng(seed)
    path = np.full((n, 3), np.nan)
    path[list(ends)] = rng.normal(size=(len(ends), 3))
    return path, rng.normal(size=(n - 1, 3))


@given(seed=seeds, n=st.integers(4, 12))
def test_between_two_ends_it_solves_the_tridiagonal_normal_equations(seed, n):
    path, steps = gap(seed, (0, -1), n)
    # stationary in y_t: 2 y_t − y_{t−1} − y_{t+1} = m_{t−1} − m_t
    right = steps[:-1] - steps[1:]
    right[0] += path[0]
    right[-1] += path[-1]
    bands = np.array([[0.0] + [-1.0] * (n - 3), [2.0] * (n - 2)])
    np.testing.assert_allclose(
        least_squares_path(steps, path)[1:-1], solveh_banded(bands, right), atol=1e-10
    )


@given(seed=seeds)
@pytest.mark.parametrize("end", [0, -1])
def test_from_one_end_it_takes_the_steps_as_they_are(seed, end):
    path, steps = gap(seed, (end,))
    filled = least_squares_path(steps, path)
    np.testing.assert_allclose(filled[end], path[end])
    np.testing.assert_allclose(np.diff(filled, axis=0), steps)


@given(seed=seeds)
def test_given_ends_do_not_change(seed):
    path, steps = gap(seed, (0, -1))
    filled = least_squares_path(steps, path)
    np.testing.assert_allclose(filled[[0, -1]], path[[0, -1]], atol=1e-12)


def test_constant_steps_give_the_straight_line():
    path, _ = gap(0, (0, -1))
    filled = fill_gap(path, np.ones_like)
    np.testing.assert_allclose(filled, np.linspace(path[0], path[-1], len(path)), atol=1e-12)


def test_fill_gap_converges_to_the_path_whose_steps_are_those_expected_on_it():
    path, _ = gap(1, (0,))
    filled = fill_gap(path, lambda places: -0.5 * places)
    np.testing.assert_allclose(np.diff(filled, axis=0), -0.5 * filled[:-1], atol=1e-9)
