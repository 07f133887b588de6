"""Power spectra: invariances, a closed form, and which runs count."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import npss, sample_npss

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
