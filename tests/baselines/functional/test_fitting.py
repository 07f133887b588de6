import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.functional.components import LEAST_NOISE, fit_components, start_components
from mocapbench.baselines.functional.phases import periodic_curve


def _fit(statistics, n_components, smoothness=0.1, max_iter=8):
    curve = periodic_curve(statistics, smoothness)
    initial = start_components(statistics, curve, n_components, smoothness)
    return fit_components(statistics, initial, smoothness, max_iter=max_iter, tol=1e-12)


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    n_components=st.integers(0, 4),
    hidden=st.sampled_from([0.0, 0.4, 0.9]),
)
def test_the_likelihood_never_falls(curves, seed, n_components, hidden):
    fit = _fit(curves(seed, hidden=hidden).statistics, n_components)
    rises = np.diff(fit.objectives)
    assert (rises >= -1e-8 * (1.0 + np.abs(fit.objectives[1:]))).all()
    assert np.isfinite(fit.state.coefficients).all()
    assert (fit.state.noise >= LEAST_NOISE).all()


def test_it_starts_with_the_singular_vectors_of_complete_cycles(curves):
    statistics = curves(3, hidden=0.0, n_curves=6).statistics
    one, three = (start_components(statistics, np.zeros((3, 5)), q, 0.1)[0] for q in (1, 3))
    assert one.shape == (2, 3, 5)
    np.testing.assert_allclose(np.abs(one[1]), np.abs(three[1]))


def test_it_ends_when_a_round_gains_too_little(curves):
    statistics = curves(0).statistics
    assert not _fit(statistics, 2, max_iter=1).converged
    curve = periodic_curve(statistics, 0.1)
    initial = start_components(statistics, curve, 2, 0.1)
    fit = fit_components(statistics, initial, 0.1, max_iter=50, tol=0.1)
    assert fit.converged
    assert fit.objectives[-1] - fit.objectives[-2] < 0.1 * statistics.counts.sum()
    assert len(fit.objectives) == pytest.approx(3, abs=2)
