"""Jerk: exact for cubic paths, on any times, and never across recordings."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import jerk_ratio, sample_jerk_ratio

N_FRAMES = 12


def cubic(scale, times):
    """Return a chain whose two lower joints have the jerk 6 × scale along one axis."""
    joints = np.zeros((len(times), 3, 3))
    joints[:, 1:, 2] = scale * np.asarray(times)[:, None] ** 3
    return joints


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 10.0))
def test_a_cubic_path_has_its_jerk_on_any_times(pose, seed, scale):
    times = np.cumsum(np.random.default_rng(seed).uniform(0.5, 2.0, N_FRAMES))
    outcome = pose(cubic(1.0, times), cubic(scale, times), times=times)
    assert jerk_ratio(outcome).value == pytest.approx(scale, rel=1e-4)
    np.testing.assert_allclose(jerk_ratio(outcome).parts["joint"], [np.nan, scale, scale], 1e-4)


def test_a_perfect_prediction_has_ratio_one(pose):
    truth = np.random.default_rng(0).normal(size=(N_FRAMES, 3, 3))
    assert jerk_ratio(pose(truth, truth)).value == 1.0


def test_what_lies_beyond_a_gap_does_not_count(pose):
    rng = np.random.default_rng(0)
    truth, mean = rng.normal(size=(2, 20, 3, 3))
    hidden = np.zeros((20, 3), dtype=bool)
    hidden[8:11, 2] = True
    whole = jerk_ratio(pose(truth, mean, hidden)).value
    cut = slice(5, 14)  # three frames on either side: as far as a third difference reaches
    assert jerk_ratio(pose(truth[cut], mean[cut], hidden[cut])).value == pytest.approx(whole)
    assert whole != pytest.approx(1.0)


def test_no_jerk_is_taken_from_one_recording_to_the_next(pose):
    times = np.arange(8.0)
    apart = np.concatenate([cubic(1.0, times), 1e3 + cubic(1.0, times)])
    mean = np.concatenate([cubic(2.0, times), 5e3 + cubic(2.0, times)])
    times = np.tile(times, 2)
    outcome = pose(apart, mean, times=times, starts=(0, 8))
    assert jerk_ratio(outcome).value == pytest.approx(2.0)


def test_a_truth_without_jerk_or_four_frames_has_no_ratio(pose):
    assert np.isnan(jerk_ratio(pose(np.zeros((N_FRAMES, 3, 3)))).value)
    assert np.isnan(jerk_ratio(pose(np.ones((3, 3, 3)))).value)


def test_samples_are_measured_by_the_mean_reference(place):
    times = np.arange(10.0)
    samples = [cubic(scale, times) for scale in (1.0, 4.0)]
    references = [cubic(scale, times) for scale in (1.0, 3.0)]
    score = sample_jerk_ratio(place(samples, references, times))
    np.testing.assert_allclose(score.parts["sample"], [0.5, 2.0])
    assert score.value == pytest.approx(1.25)
