"""Recovery of covariances: closed forms and invariances."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import Recovery, frobenius_child, frobenius_parent, logdet_child
from mocapbench.metrics.recovery import log_det_divergence, relative_frobenius

NOISE = 0.1


def _matrix(seed, n=4):
    factor = np.random.default_rng(seed).normal(size=(n, n))
    return factor @ factor.T


def _recovery(truth, estimate, noise=NOISE):
    return Recovery({"child": truth}, {"child": estimate}, noise)


@given(factor=st.floats(0.0, 5.0), seed=st.integers(0, 2**32 - 1))
def test_a_multiple_of_the_truth_is_off_by_the_factor(factor, seed):
    truth = _matrix(seed)
    score = relative_frobenius(_recovery(truth, factor * truth), "child")
    assert score.value == pytest.approx(abs(factor - 1.0), abs=1e-12)


@given(factor=st.floats(0.05, 20.0), seed=st.integers(0, 2**32 - 1))
def test_a_multiple_of_the_observed_covariance_has_a_divergence_in_closed_form(factor, seed):
    observed = _matrix(seed) + NOISE * np.eye(4)
    estimate = factor * observed - NOISE * np.eye(4)
    outcome = _recovery(observed - NOISE * np.eye(4), estimate)
    expected = 4 * (1 / factor + np.log(factor) - 1.0)
    assert log_det_divergence(outcome, "child").value == pytest.approx(expected, abs=1e-8)


def test_the_divergence_is_twice_the_mean_log_ratio_of_the_densities():
    truth, estimate = _matrix(0), _matrix(1)
    a, b = truth + NOISE * np.eye(4), estimate + NOISE * np.eye(4)
    curves = np.random.default_rng(2).multivariate_normal(np.zeros(4), a, 200_000)

    def minus_twice_log_density(covariance):
        quadratic = np.sum(curves * np.linalg.solve(covariance, curves.T).T, axis=1)
        return quadratic + np.linalg.slogdet(covariance)[1]

    differences = minus_twice_log_density(b) - minus_twice_log_density(a)
    error = differences.std() / np.sqrt(len(differences))
    score = log_det_divergence(_recovery(truth, estimate), "child")
    assert score.value == pytest.approx(differences.mean(), abs=4 * error)


@given(seed=st.integers(0, 2**32 - 1))
def test_a_change_of_basis_changes_nothing(seed):
    truth, estimate = _matrix(seed), _matrix(seed + 1)
    basis, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(4, 4)))
    turned = _recovery(basis @ truth @ basis.T, basis @ estimate @ basis.T)
    for metric in (relative_frobenius, log_det_divergence):
        one, other = metric(_recovery(truth, estimate), "child"), metric(turned, "child")
        assert one.value == pytest.approx(other.value, rel=1e-6)


def test_errors_far_below_the_noise_hardly_count():
    truth = np.diag([1.0, 1.0, 1e-9])
    assert log_det_divergence(_recovery(truth, np.diag([1.0, 1.0, 0.0])), "child").value < 1e-12
    assert log_det_divergence(_recovery(truth, np.diag([1.0, 0.0, 0.0])), "child").value > 1.0


def test_metrics_of_a_layer_need_its_estimate():
    outcome = Recovery({"parent": np.eye(2), "child": np.eye(2)}, {"child": np.eye(2)}, NOISE)
    assert frobenius_child.applies(outcome)
    assert logdet_child.applies(outcome)
    assert not frobenius_parent.applies(outcome)


def test_malformed_recoveries_are_refused():
    with pytest.raises(ValueError, match=r"square matrices .* got shapes \(2, 2\) and \(3, 3\)"):
        _recovery(np.eye(2), np.eye(3))
    with pytest.raises(ValueError, match=r"layer 'child' among the true .* \['parent'\]"):
        Recovery({"parent": np.eye(2)}, {"child": np.eye(2)}, NOISE)
    with pytest.raises(ValueError, match="positive variance of the noise, got 0"):
        log_det_divergence(_recovery(np.eye(2), np.eye(2), noise=0.0), "child")


def test_a_layer_without_an_estimate_is_named():
    outcome = _recovery(np.eye(2), np.eye(2))
    with pytest.raises(ValueError, match=r"layer 'parent' among the estimated .* \['child'\]"):
        frobenius_parent(outcome)
