import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.functional.fourier_series import CurveStatistics, fourier, shift_matrices


def _errors(statistics, coefficients):
    quadratic = np.einsum("dp,jdpq,dq->jd", coefficients, statistics.grams, coefficients)
    return (
        statistics.squares
        - 2.0 * np.einsum("dp,jdp->jd", coefficients, statistics.cross)
        + (quadratic)
    )


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_they_hold_the_squared_error_of_any_coefficients(curves, seed):
    given_curves = curves(seed)
    coefficients = np.random.default_rng(seed).normal(size=(3, 5))
    expected = [
        np.nansum((values - fourier(phases, 2) @ coefficients.T) ** 2, axis=0)
        for phases, values in given_curves.pairs
    ]
    np.testing.assert_allclose(_errors(given_curves.statistics, coefficients), expected, atol=1e-8)
    counts = [(~np.isnan(values)).sum(axis=0) for _, values in given_curves.pairs]
    np.testing.assert_array_equal(given_curves.statistics.counts, counts)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_those_of_shifted_curves_follow_from_a_matrix(curves, seed):
    given_curves = curves(seed)
    shifts = np.random.default_rng(seed).random(5)
    moved = given_curves.statistics.shift_curves(shift_matrices(shifts, 2))
    pairs = [(p + s, v) for (p, v), s in zip(given_curves.pairs, shifts, strict=True)]
    again = CurveStatistics.of(pairs, 2)
    np.testing.assert_allclose(moved.grams, again.grams, atol=1e-9)
    np.testing.assert_allclose(moved.cross, again.cross, atol=1e-9)
