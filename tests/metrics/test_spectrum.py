"""Power spectra: invariances, a closed form, and which runs count."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import npss, npss_real_part, sample_npss

N_FRAMES = 12
TIMES = np.arange(N_FRAMES)


@pytest.fixture(scope="module")
def of_waves(pose):
    """Return a function from truth and prediction (N, D) to an outcome in which all is hidden."""

    def of_waves(truth, mean, hidden=None):
        hidden = np.full(truth.shape, True) if hidden is None else hidden
        posed = pose(np.zeros((N_FRAMES, 3, 3)))
        return replace(posed, truth=truth, mean=mean, hidden=hidden)

    return of_waves


def wave(cycles, phase=0.0):
    return np.tile(np.sin(2 * np.pi * cycles * TIMES / N_FRAMES + phase)[:, None], (1, 4))


@given(st.integers(1, 5), st.floats(0.0, 6.0), st.floats(0.1, 10.0))
def test_phase_and_scale_do_not_matter(of_waves, cycles, phase, scale):
    assert npss(of_waves(wave(cycles), scale * wave(cycles, phase))).value == pytest.approx(0.0)


def test_frequencies_apart_count_by_their_distance(of_waves):
    # A sine of k cycles has half its power at the frequency k, and half at N − k.
    assert npss(of_waves(wave(2), wave(4))).value == pytest.approx(0.5 * 2 + 0.5 * 2)


def test_outputs_count_by_their_true_power(of_waves):
    truth = wave(2) * [1.0, 3.0, 0.0, 0.0]
    mean = np.column_stack([wave(4)[:, 0], wave(2)[:, 0], wave(5)[:, 0], wave(5)[:, 0]])
    assert npss(of_waves(truth, mean)).value == pytest.approx(2.0 * 1 / (1 + 9))


def test_only_long_runs_are_compared(of_waves):
    hidden = np.zeros((N_FRAMES, 4), dtype=bool)
    hidden[2:5, 0] = True
    assert np.isnan(npss(of_waves(wave(2), wave(4), hidden)).value)
    hidden[4:8, 1] = True
    alone = of_waves(wave(2), wave(4), hidden & [False, True, False, False])
    assert npss(of_waves(wave(2), wave(4), hidden)).value == npss(alone).value > 0.0


def test_a_truth_without_power_has_no_score(of_waves):
    assert np.isnan(npss(of_waves(np.zeros((N_FRAMES, 4)), wave(1))).value)


def test_samples_are_compared_with_every_reference(place):
    def motion(cycles):
        joints = np.zeros((N_FRAMES, 3, 3))
        joints[:, 2, 2] = wave(cycles)[:, 0]
        return joints

    score = sample_npss(place([motion(2), motion(4)], [motion(2), motion(2)]))
    np.testing.assert_allclose(score.parts["sample"], [0.0, 2.0], atol=1e-9)
    assert score.value == pytest.approx(1.0)


def waves(*parts):
    """Return four outputs of a level, amplitude, cycles and phase each."""
    columns = [
        level + size * np.cos(2 * np.pi * cycles * TIMES / N_FRAMES + phase)
        for level, size, cycles, phase in parts
    ]
    return np.column_stack(columns)


def real_power(level, size, phase):
    """Return the squared real part of the spectrum at frequency 0, and in all, over N²."""
    return level**2, level**2 + (size * np.cos(phase)) ** 2 / 2


@given(st.integers(1, 5), st.floats(0.0, 1.0), st.floats(0.1, 2.0), st.floats(0.1, 2.0))
def test_by_the_real_part_a_phase_lowers_the_power_of_a_wave(of_waves, cycles, phase, level, size):
    """What it loses, the level gains: half of that at k of N frequencies, half at N − k."""
    truth = waves(*[(level, size, cycles, 0.0)] * 4)
    mean = waves(*[(level, size, cycles, phase)] * 4)
    (one, all_one), (two, all_two) = real_power(level, size, 0.0), real_power(level, size, phase)
    gained = two / all_two - one / all_one
    outcome = of_waves(truth, mean)
    expected = pytest.approx(gained * N_FRAMES / 2, abs=1e-9)
    assert npss_real_part(outcome).value == expected
    assert npss(outcome).value == pytest.approx(0.0, abs=1e-9)


def test_by_the_real_part_outputs_count_by_its_power_in_the_truth(of_waves):
    phases = (0.0, 1.0, 0.5, 0.2)
    truth = waves(*[(0.0, 1.0 + k, 2, phase) for k, phase in enumerate(phases)])
    mean = waves((0.0, 1.0, 4, 0.3), *[(0.0, 1.0, 2, 1.2)] * 3)
    powers = [real_power(0.0, 1.0 + k, phase)[1] for k, phase in enumerate(phases)]
    expected = pytest.approx(2.0 * powers[0] / sum(powers))
    assert npss_real_part(of_waves(truth, mean)).value == expected


def test_by_the_real_part_it_is_what_the_transform_of_each_run_gives(of_waves):
    rng = np.random.default_rng(0)
    truth, mean = rng.normal(size=(2, N_FRAMES, 4))
    powers, distances = [], []
    for output in range(4):
        cycles = np.arange(N_FRAMES)[:, None] * TIMES
        cosines = np.cos(2 * np.pi * cycles / N_FRAMES)
        one, two = (cosines @ values[:, output] for values in (truth, mean))
        shares = [np.cumsum(part**2) / np.sum(part**2) for part in (one, two)]
        distances.append(np.abs(shares[0] - shares[1]).sum())
        powers.append(np.sum(one**2))
    expected = pytest.approx(np.average(distances, weights=powers))
    assert npss_real_part(of_waves(truth, mean)).value == expected
