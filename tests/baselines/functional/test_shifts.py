import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.functional.fourier_series import CurveStatistics, fourier, roughness
from mocapbench.baselines.functional.phases import (
    SHIFTS,
    periodic_curve,
    prediction_errors,
    shift_together,
)


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10**6), smoothness=st.sampled_from([1e-3, 0.1, 10.0]))
def test_the_curve_is_the_penalised_regression(curves, seed, smoothness):
    given_curves = curves(seed)
    found = periodic_curve(given_curves.statistics, smoothness)
    phases = np.concatenate([phases for phases, _ in given_curves.pairs])
    values = np.concatenate([values for _, values in given_curves.pairs])
    for channel, coefficients in zip(values.T, found, strict=True):
        seen = ~np.isnan(channel)
        # ridge regression as least squares with one more row for each coefficient
        rows = np.vstack([fourier(phases[seen], 2), np.diag(np.sqrt(smoothness * roughness(2)))])
        target = np.concatenate([channel[seen], np.zeros(5)])
        expected = np.linalg.lstsq(rows, target, rcond=None)[0]
        np.testing.assert_allclose(coefficients, expected, atol=1e-5)


def test_a_curve_of_much_penalty_is_the_mean(curves):
    given_curves = curves(1)
    curve = periodic_curve(given_curves.statistics, 1e9)
    values = np.concatenate([values for _, values in given_curves.pairs])
    weight = 1e9 * roughness(2)[0]  # the constant has a little weight too
    counts = (~np.isnan(values)).sum(axis=0)
    np.testing.assert_allclose(curve[:, 0], np.nansum(values, axis=0) / (counts + weight))
    np.testing.assert_allclose(curve[:, 1:], 0.0, atol=1e-6)


def test_prediction_errors_are_those_of_each_shift(curves):
    given_curves = curves(2)
    curve = np.random.default_rng(3).normal(size=(3, 5))
    found = prediction_errors(given_curves.statistics, curve)
    for errors, (phases, values) in zip(found, given_curves.pairs, strict=True):
        expected = [np.nansum((values - fourier(phases + s, 2) @ curve.T) ** 2) for s in SHIFTS]
        np.testing.assert_allclose(errors, expected, atol=1e-8)


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 10**6), first=st.integers(0, 4))
def test_the_objective_never_rises(curves, seed, first):
    *_, objectives = map(np.array, shift_together(curves(seed).statistics, first, 0.1))
    assert (np.diff(objectives) <= 1e-9 * (1.0 + objectives[:-1])).all()


@pytest.mark.parametrize("hidden", [0.0, 0.4])
def test_recordings_are_shifted_to_a_common_phase(waves, hidden):
    cyclic = waves([18.0, 22.0, 30.0, 25.0], hidden=hidden)
    paths = [np.arange(90) / period for period in (18.0, 22.0, 30.0, 25.0)]
    pairs = [(p, r.values) for p, r in zip(paths, cyclic.recordings, strict=True)]
    _, shifts, _ = shift_together(CurveStatistics.of(pairs, 4), 2, 0.01)
    true = np.array([phases[0] for phases in cyclic.phases])
    gaps = SHIFTS[shifts] - true
    np.testing.assert_allclose((gaps - gaps[2] + 0.5) % 1.0, 0.5, atol=0.02)
