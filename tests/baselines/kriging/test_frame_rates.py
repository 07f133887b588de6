"""Recordings of many frames per second are filled as ones of thirty are."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from mocapbench.baselines import PoseKriging, Prediction
from mocapbench.baselines.kriging.frame_rates import keep_thirty_frames, restore_frames
from mocapbench.datasets import Recording, joint_trajectories, open_archive

RATES = st.sampled_from([20.0, 30.0, 44.0, 50.0, 60.0, 100.0, 120.0, 250.0])


def _record(rate, n_frames, hidden=slice(0, 0)):
    """Return two channels that are cubic polynomials of time."""
    times = np.arange(n_frames) / rate
    values = np.column_stack([times**3 - times, 2.0 - times**2])
    mask = np.zeros(values.shape, dtype=bool)
    mask[hidden] = True
    return Recording("r", times, values, ("a", "b"), ("cm", "cm")), mask


@given(RATES, st.integers(2, 80), st.integers(0, 60), st.integers(0, 30))
def test_what_is_kept_has_thirty_frames_and_covers_all_hidden_ones(rate, n_frames, start, length):
    full, mask = _record(rate, n_frames, slice(start, start + length))
    given_ = full.hide(mask)
    slow, places = keep_thirty_frames(given_)
    complete = given_.visible.all(axis=1)
    step = rate / 30.0 if round(rate / 30.0) > 1 else 1.0
    assert complete[0] or places[0] <= 0
    assert complete[-1] or places[-1] >= n_frames - 1
    assert (np.abs(np.diff(places) - step) < step).all()  # moved by less than half a step
    inside = (places >= 0) & (places <= n_frames - 1)
    near = np.where(inside, places, 0.0)
    between = inside & complete[np.floor(near).astype(int)] & complete[np.ceil(near).astype(int)]
    np.testing.assert_array_equal(slow.visible.all(axis=1), between)
    np.testing.assert_allclose(slow.times, places / rate, atol=1e-12)


@given(RATES, st.integers(2, 80))
def test_frames_between_those_of_the_recording_are_those_of_the_motion(rate, n_frames):
    full, _ = _record(rate, max(n_frames, 4))
    slow, places = keep_thirty_frames(full)
    times = places / rate
    expected = np.column_stack([times**3 - times, 2.0 - times**2])
    np.testing.assert_allclose(slow.values, expected, atol=1e-9 * (1.0 + times.max() ** 3))


@given(st.floats(1.0, 44.0), st.integers(2, 40))
def test_of_thirty_frames_or_fewer_all_are_kept(rate, n_frames):
    full, _ = _record(rate, n_frames)
    assert keep_thirty_frames(full)[0] is full


@given(RATES, st.integers(64, 160), st.integers(0, 60), st.integers(0, 30))
def test_a_smooth_motion_that_is_known_at_thirty_frames_is_known_at_all(
    rate, n_frames, start, length
):
    full, mask = _record(rate, n_frames, slice(start, start + length))
    given_ = full.hide(mask)
    slow, kept = keep_thirty_frames(given_)
    times = kept / rate
    mean = np.column_stack([times**3 - times, 2.0 - times**2])
    found = Prediction.around(slow, mean, np.ones(slow.values.shape))
    restored = restore_frames(given_, found, kept)
    np.testing.assert_allclose(restored.mean, full.values, atol=1e-9 * (1.0 + times.max() ** 3))
    assert (restored.variance[~mask] == 0.0).all()
    assert (restored.variance[mask] <= 1.0 + 1e-12).all()


@pytest.mark.parametrize(("n_frames", "hidden"), [(2, 1), (3, 0), (3, 2)])
def test_a_recording_of_as_many_frames_as_are_kept_is_filled_at_its_own(n_frames, hidden):
    times = np.arange(n_frames) / 60.0
    full = Recording("r", times, times[:, None], ("a",), ("cm",))
    given_ = full.hide((np.arange(n_frames) == hidden)[:, None])
    slow, kept = keep_thirty_frames(given_)
    found = Prediction.around(slow, kept[:, None] / 60.0)
    np.testing.assert_allclose(restore_frames(given_, found, kept).mean, full.values, atol=1e-12)


@pytest.mark.parametrize("rate", [50.0, 100.0, 120.0, 250.0])
def test_pose_kriging_fills_alike_at_any_frame_rate(rate):
    archive, frames = open_archive(), np.arange(0, 196, 4)  # 1.6 s
    uris = ("gait:01_01", "gait:02_01", "gait:03_01")
    slow = [
        joint_trajectories(archive.skeleton(uri), archive.recording(uri).frames(frames))
        for uri in uris
    ]
    fast = [_resample(walk, rate) for walk in slow]
    here = _fill_between(slow, 0.5, 1.0)
    there = CubicSpline(fast[-1].times, _fill_between(fast, 0.5, 1.0))(slow[-1].times)
    error = np.abs(here - slow[-1].values).max()
    np.testing.assert_allclose(there[15:31], here[15:31], atol=0.02 * error)


def _resample(walk, rate):
    times = np.arange(round(rate * walk.times[-1]) + 1) / rate
    values = CubicSpline(walk.times, walk.values)(times)
    return Recording(walk.name, times, values, walk.channels, walk.units)


def _fill_between(walks, start, end):
    """Return a fill of the last walk where its times are between two, both visible."""
    *training, walk = walks
    hidden = (walk.times > start + 1e-9) & (walk.times < end - 1e-9)
    gap = np.repeat(hidden[:, None], walk.values.shape[1], axis=1)
    return PoseKriging().fit(training).impute([walk.hide(gap)])[0].mean
