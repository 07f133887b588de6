import numpy as np
from scipy.linalg import cho_factor

from mocapbench.baselines.kriging.left_out import left_out_scales


def test_every_recording_is_predicted_from_the_others():
    rng = np.random.default_rng(0)
    recording, values = np.array([0, 0, 1, 1, 1, 4, 4]), rng.normal(size=(7, 2))
    root = rng.normal(size=(7, 9))
    covariance = root @ root.T
    ratios = []
    for number in (0, 1, 4):
        own, others = recording == number, recording != number
        gain = covariance[np.ix_(own, others)] @ np.linalg.inv(covariance[np.ix_(others, others)])
        variance = np.diag(covariance[np.ix_(own, own)] - gain @ covariance[np.ix_(others, own)])
        ratios.append((values[own] - gain @ values[others]) ** 2 / variance[:, None])
    factor, _ = cho_factor(covariance, lower=True)
    scales = left_out_scales(factor, np.linalg.solve(covariance, values), recording)
    np.testing.assert_allclose(scales, np.concatenate(ratios).mean(axis=0))


def test_a_single_recording_is_compared_with_the_prior():
    rng = np.random.default_rng(1)
    values = 3.0 * rng.normal(size=(5, 1))
    factor, _ = cho_factor(4.0 * np.eye(5), lower=True)
    scales = left_out_scales(factor, values / 4.0, np.zeros(5, dtype=int))
    np.testing.assert_allclose(scales, (values**2).mean() / 4.0)
