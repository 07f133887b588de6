import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.baselines.common.prototypes import cluster_cycles, of_unit_variance, tempi

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


def path_of(advances, start=0, n_states=12):
    return (start + np.concatenate([[0], np.cumsum(advances)])).astype(int) % n_states


@given(st.lists(st.lists(st.integers(1, 5), max_size=9), min_size=1, max_size=6))
def test_tempi_lie_on_their_side_of_the_mean_and_vary_by_at_most_one(advances):
    tempo = tempi([path_of(a, start) for start, a in enumerate(advances)], 12)
    assert np.isfinite(tempo).all()
    assert tempo.var() <= 1.0 + 1e-9
    assert not any(of for of, a in zip(tempo, advances, strict=True) if not a)
    logs = [np.log(np.mean(a)) for a in advances if a]
    known = [of for of, a in zip(tempo, advances, strict=True) if a]
    assert all(of * (log - np.mean(logs)) >= 0.0 for of, log in zip(known, logs, strict=True))


def test_steady_tempi_have_variance_1_and_do_not_depend_on_the_number_of_states():
    advances = [[1] * 20, [2] * 15, [3] * 30]
    tempo = tempi([path_of(a) for a in advances], 12)
    np.testing.assert_allclose(tempo, stats.zscore(np.log([1, 2, 3])))
    finer = tempi([path_of(np.multiply(a, 2), n_states=24) for a in advances], 24)
    np.testing.assert_allclose(finer, tempo)


def test_tempi_that_differ_by_chance_do_not_count():
    rng = np.random.default_rng(2)
    lengths = [40] * 150 + [
        1
    ] * 50  # frames that follow: also of two frames, whose spread is not known
    chance = tempi([path_of(rng.integers(1, 4, size=n)) for n in lengths], 12)
    assert chance.var() < 0.2
    assert not tempi([path_of([1, 3, 1, 3]), path_of([3, 1, 3, 1])], 12).any()


def test_a_tempo_counts_less_the_shorter_its_recording_is():
    rng = np.random.default_rng(3)
    long = [rng.integers(low, low + 3, size=(3, 60)) for low in (1, 5)]
    paths = [path_of(a) for of, low in zip(long, (1, 5), strict=True) for a in (*of, [low + 1])]
    tempo = tempi(paths, 24).reshape(2, 4)
    assert (np.sign(tempo) == [[-1.0], [1.0]]).all()
    assert (np.abs(tempo[:, -1]) < np.abs(tempo[:, :-1]).min(axis=1)).all()


def test_the_first_axis_of_features_gets_variance_1():
    features = np.random.default_rng(3).normal(size=(9, 4)) * [9.0, 1.0, 1.0, 1.0] + 5.0
    scaled = of_unit_variance(features)
    variances = np.linalg.eigvalsh(np.cov(scaled.T, ddof=0))
    assert variances.max() == pytest.approx(1.0)
    np.testing.assert_allclose(scaled.mean(axis=0), 0.0, atol=1e-12)
    assert not of_unit_variance(np.full((7, 3), 0.1) * 3.0).any()  # equal but for rounding
