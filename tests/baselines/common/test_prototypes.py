import numpy as np

from mocapbench.baselines.common.prototypes import cluster_cycles

RNG = np.random.default_rng(0)
CENTRES = np.array([0.0, 3.0, 0.0, 3.0, 3.0])
CYCLES = CENTRES[:, None, None] * [1.0, 0.0] + 0.01 * RNG.normal(size=(5, 8, 2))


def test_recordings_are_grouped_by_their_cycles():
    labels, means = cluster_cycles(CYCLES, np.ones(2), 2, 3, np.random.default_rng(1))
    np.testing.assert_array_equal(labels == labels[0], CENTRES == 0.0)
    for label in (0, 1):
        np.testing.assert_allclose(means[label], CYCLES[labels == label].mean(axis=0))


def test_the_scale_decides_which_channel_counts():
    cycles = CYCLES + np.array([0.0, 1.0]) * np.array([0, 0, 1, 1, 1])[:, None, None]
    labels, _ = cluster_cycles(cycles, np.array([1e3, 1.0]), 2, 3, np.random.default_rng(1))
    np.testing.assert_array_equal(labels == labels[0], [True, True, False, False, False])


def test_more_styles_than_recordings_give_each_its_own():
    labels, means = cluster_cycles(CYCLES, np.ones(2), 9, 1, np.random.default_rng(1))
    assert sorted(labels) == [0, 1, 2, 3, 4]
    np.testing.assert_allclose(means[labels], CYCLES)
