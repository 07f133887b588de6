import numpy as np
import pytest

from mocapbench.baselines.kriging.mirror_images import Image, MirroredResiduals, images_of

ORDER, SIGNS = np.array([0, 2, 1]), np.array([-1.0, 1.0, 1.0])
"""One channel in the middle, whose sign the mirror changes, and one on each side."""
IMAGES = (Image.itself(3), Image(ORDER, SIGNS))
N = 7
VISIBLE = np.array([1, 1, 0, 0, 1, 1, 1], dtype=bool)
MATCHED = np.random.default_rng(0).normal(size=(N, 3)).cumsum(axis=0)


def residuals(symmetry):
    return MirroredResiduals(IMAGES, 2.0, 3.0, 4.0, symmetry)


def groups(symmetry):
    return {
        tuple(channels): process
        for channels, process in residuals(symmetry).condition(MATCHED, VISIBLE)
    }


def test_frames_and_their_images_have_the_covariance_of_the_formula():
    process, (here, there) = (
        residuals(0.8),
        images_of(MATCHED - [MATCHED[:, 0].mean(), 0, 0], IMAGES).reshape(2, N, 3),
    )
    covariance = process.covariance(MATCHED)
    t, u = 2, 5
    pose = 3.0 * np.exp(-((here[t] - here[u]) ** 2).sum() / 4.0)
    assert covariance[t, u] == pytest.approx(pose + np.exp(-3.0 / 4.0))
    across = 3.0 * np.exp(-((here[t] - there[u]) ** 2).sum() / 4.0)
    assert covariance[t, N + u] == pytest.approx(0.8 * across)


@pytest.mark.parametrize("symmetry", [0.3, 0.8, 1.0])
def test_constants_of_two_sides_differ_as_much_as_symmetry_says(symmetry):
    """Dense: constants (a, b) of variance 10, correlated by ρ, and one in common that is free."""
    given = groups(symmetry)[(False, True, True)]
    constants = np.array([[1.0, symmetry], [symmetry, 1.0]]) * 10.0 + 1e7
    dense = residuals(symmetry).covariance(MATCHED) + np.kron(constants, np.ones((N, N)))
    seen = np.tile(VISIBLE, 2)
    values = np.random.default_rng(1).normal(size=(seen.sum(), 1)) + 5.0
    noisy = dense[np.ix_(seen, seen)] + 0.05 * np.eye(seen.sum())
    expected = dense[:, seen] @ np.linalg.solve(noisy, values)
    np.testing.assert_allclose(given.mean(values), expected, atol=1e-4)
    explained = np.diag(dense[:, seen] @ np.linalg.solve(noisy, dense[seen]))
    np.testing.assert_allclose(given.variance, np.diag(dense) + 0.05 - explained, rtol=1e-4)


def test_channels_in_the_middle_have_a_constant_for_each_image():
    (given,) = (each for channels, each in groups(0.8).items() if channels[0])
    np.testing.assert_array_equal(given.trend, np.kron(np.eye(2), np.ones((N, 1))))


def test_without_symmetry_the_sides_have_nothing_in_common():
    ((channels, given),) = groups(0.0).items()
    assert all(channels)
    np.testing.assert_array_equal(given.prior[:N, N:], 0.0)
