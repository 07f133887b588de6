import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.alignment.ring import eliminate, solve_rings, sweep_back


def _dense(edge, ground):
    laplacian = 2.0 * np.eye(len(ground))
    for m in range(len(ground)):
        laplacian[m, (m + 1) % len(ground)] -= 1.0
        laplacian[(m + 1) % len(ground), m] -= 1.0
    return edge * laplacian + np.diag(ground)


@given(
    n_states=st.integers(3, 9),
    log_edge=st.floats(-6.0, 6.0),
    seed=st.integers(0, 2**32 - 1),
)
def test_moments_are_those_of_the_dense_gaussian(n_states, log_edge, seed):
    rng = np.random.default_rng(seed)
    edge = 10.0**log_edge
    ground = np.exp(rng.normal(0.0, 2.0, (n_states, 2, 3)))
    right = rng.normal(size=ground.shape)
    ring = solve_rings(edge, ground, right)
    tolerance = {"rtol": 1e-13 * max(1e3, edge / ground.min()), "atol": 1e-12}
    for c, f in np.ndindex(2, 3):
        precision = _dense(edge, ground[:, c, f])
        covariance = np.linalg.inv(precision)
        np.testing.assert_allclose(ring.mean[:, c, f], covariance @ right[:, c, f], **tolerance)
        np.testing.assert_allclose(ring.variance[:, c, f], np.diag(covariance), **tolerance)
        after = (np.arange(n_states) + 1) % n_states
        np.testing.assert_allclose(
            ring.neighbour[:, c, f], covariance[np.arange(n_states), after], **tolerance
        )
        assert ring.log_determinant[c, f] == pytest.approx(
            np.linalg.slogdet(precision)[1], rel=1e-9, abs=1e-9
        )


def test_nothing_cancels_on_a_very_smooth_ring():
    ring = solve_rings(1e12, np.full(5, 0.2), np.ones(5))
    np.testing.assert_allclose(ring.mean, 5.0, rtol=1e-12)
    np.testing.assert_allclose(ring.variance, 1.0, rtol=1e-11)


def test_rolling_the_ring_rolls_the_answer():
    rng = np.random.default_rng(0)
    ground, right = rng.uniform(0.1, 2.0, (7, 4)), rng.normal(size=(7, 4))
    ring = solve_rings(3.0, ground, right)
    rolled = solve_rings(3.0, np.roll(ground, 2, axis=0), np.roll(right, 2, axis=0))
    for name in ("mean", "variance", "neighbour"):
        np.testing.assert_allclose(
            getattr(rolled, name), np.roll(getattr(ring, name), 2, axis=0), rtol=1e-12
        )


def test_the_backward_sweep_makes_white_noise_the_rings_own():
    ground = np.random.default_rng(0).uniform(0.1, 2.0, 6)
    pivots, near, far = eliminate(1.5, ground)
    root = np.column_stack([sweep_back(near, far, e) for e in np.diag(pivots**-0.5)])
    np.testing.assert_allclose(root @ root.T, np.linalg.inv(_dense(1.5, ground)), rtol=1e-12)
