import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging.conditioned import ConditionedFrames


def frames(seed, n=12):
    """Return a random covariance, which frames are visible, and residuals there."""
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(n, n))
    visible = rng.random(n) < 0.6
    visible[[0, 1, 2]] = True
    return ConditionedFrames(factor @ factor.T, 0.3, visible), rng.normal(size=(visible.sum(), 3))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_moments_are_those_of_the_joint_normal(seed):
    process, residuals = frames(seed)
    hidden, visible = ~process.visible, process.visible
    noisy = process.prior + 0.3 * np.eye(len(visible))
    precision = np.linalg.inv(noisy)
    block = np.linalg.inv(precision[np.ix_(hidden, hidden)])
    expected = -block @ precision[np.ix_(hidden, visible)] @ residuals
    np.testing.assert_allclose(process.mean(residuals)[hidden], expected, atol=1e-7)
    np.testing.assert_allclose(process.variance[hidden], np.diag(block), rtol=1e-7)
    inverse = np.linalg.inv(noisy[np.ix_(visible, visible)])
    scales = np.diag(residuals.T @ inverse @ residuals) / visible.sum()
    np.testing.assert_allclose(process.scales(residuals, 1e-300), scales)


def test_evidence_differs_as_the_density_of_a_student_t():
    """Up to a constant, the evidence is −½ ln|K| − n/2 ln rᵀK⁻¹r."""
    (one, residuals), (two, _) = frames(0), frames(0)
    two = ConditionedFrames(2.0 * two.prior, two.noise, two.visible)

    def evidence(process):
        among = process.prior[np.ix_(process.visible, process.visible)]
        among = among + process.noise * np.eye(len(among))
        quadratic = np.diag(residuals.T @ np.linalg.solve(among, residuals))
        return -0.5 * np.linalg.slogdet(among)[1] - 0.5 * len(among) * np.log(quadratic)

    found = [process.log_evidence(process.scales(residuals, 1e-300)) for process in (one, two)]
    np.testing.assert_allclose(found[1] - found[0], evidence(two) - evidence(one))


@pytest.mark.parametrize(("n_visible", "factor"), [(1, 3.0), (2, 3.0), (3, 3.0), (12, 1.2)])
def test_fewer_visible_frames_leave_more_doubt_of_the_scale(n_visible, factor):
    visible = np.arange(20) < n_visible
    assert ConditionedFrames(np.eye(20), 1.0, visible).doubt_of_scale == pytest.approx(factor)
