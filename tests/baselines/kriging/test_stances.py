"""Where markers stand and face is taken out, whatever it was, and put back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mocapbench.baselines.kriging.stances import find_reference, find_stance, find_stances
from mocapbench.datasets import Recording

N_FRAMES, MARKERS = 12, "abcde"
CHANNELS = (*(f"{marker}.{axis}" for marker in MARKERS for axis in "xyz"), "force")
UNITS = (*["mm"] * 15, "N")
SEEDS = st.integers(0, 1000)


def _walk(seed, name):
    """Return five markers that move along, and swing about a shape that all walkers share."""
    rng = np.random.default_rng(seed)
    shape = np.random.default_rng(0).normal(size=(5, 3))
    path = np.linspace(0, 1, N_FRAMES)[:, None, None] * rng.normal(size=3)
    swing = 0.1 * rng.normal(size=(N_FRAMES, 5, 3))
    values = np.column_stack([(shape + path + swing).reshape(N_FRAMES, 15), rng.random(N_FRAMES)])
    return Recording(name, np.arange(N_FRAMES) / 30, values, CHANNELS, UNITS)


def _move(recording, seed):
    """Return a recording turned in space by chance, and moved."""
    about, away = Rotation.random(random_state=seed), np.array([3.0, -1.0, 2.0])
    values = recording.values.copy()
    values[:, :15] = (about.apply(values[:, :15].reshape(-1, 3)) + away).reshape(-1, 15)
    return recording.with_values(values)


def _hide(recording):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[4:8, :6] = True
    return recording.hide(hidden)


@given(SEEDS)
def test_what_is_seen_from_the_body_does_not_depend_on_where_it_stands_and_faces(seed):
    other, walk = _walk(seed, "other"), _hide(_walk(seed + 1, "walk"))
    moved = _move(walk, seed)
    (_, here), (_, there) = find_stances([other, walk], 1), find_stances([other, moved], 1)
    np.testing.assert_allclose(there.take_out(moved).values, here.take_out(walk).values, atol=1e-9)


@given(SEEDS)
def test_what_is_taken_out_is_put_back(seed):
    walk = _walk(seed + 1, "walk")
    given_, ones = _hide(walk), np.ones(walk.values.shape)
    _, stance = find_stances([_walk(seed, "other"), given_], 1)
    seen = stance.take_out(walk).values
    prediction = stance.put_back(given_, seen, ones)
    np.testing.assert_allclose(prediction.mean, walk.values, atol=1e-9)
    np.testing.assert_allclose(prediction.variance[4:8, :6], 1.0)  # alike in all directions


@given(SEEDS)
def test_a_variance_turns_with_what_it_is_of(seed):
    walk = _hide(_walk(seed + 1, "walk"))
    moved = _move(walk, seed)
    variance = np.random.default_rng(seed).random(walk.values.shape)
    _, stance = find_stances([_walk(seed, "other"), moved], 1)
    got = stance.put_back(moved, moved.values.copy(), variance).variance
    covariances = [np.diag(v) for v in variance[:, :15].reshape(-1, 3)]
    rotated = [stance.rotation.T @ c @ stance.rotation for c in covariances]
    expected = np.array([np.diag(c) for c in rotated]).reshape(N_FRAMES, 15)
    np.testing.assert_allclose(got[4:8, :6], expected[4:8, :6])


def test_other_channels_stay_as_they_are():
    walks = [_walk(0, "other"), _hide(_walk(1, "walk"))]
    for stance, walk in zip(find_stances(walks, 1), walks, strict=True):
        np.testing.assert_array_equal(stance.take_out(walk).values[:, 15], walk.values[:, 15])


@pytest.mark.parametrize("n_hidden", [3, 4, 5])
def test_without_three_markers_that_are_always_visible_nothing_is_taken_out(n_hidden):
    hidden = np.zeros((N_FRAMES, 16), dtype=bool)
    hidden[5, : 3 * n_hidden] = True
    walk = _walk(1, "walk").hide(hidden)
    assert all(not each.places.size for each in find_stances([_walk(0, "other"), walk], 1))
    (_, stance) = find_stances([_walk(0, "other"), walk], 1)
    assert stance.take_out(walk) is walk


def test_markers_on_a_line_are_moved_and_not_turned():
    line = np.zeros((N_FRAMES, 16))
    line[:, :15:3] = np.arange(5)
    walks = [Recording(n, np.arange(N_FRAMES), line, CHANNELS, UNITS) for n in ("a", "b")]
    for stance in find_stances(walks, 0):
        np.testing.assert_array_equal(stance.rotation, np.eye(3))
        assert stance.places.size


def test_a_recording_alone_keeps_its_direction():
    (stance,) = find_stances([_walk(3, "walk")], 0)
    np.testing.assert_allclose(stance.rotation, np.eye(3), atol=1e-12)


def _hide_frames(recording):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[4:8] = True
    return recording.hide(hidden)


@given(SEEDS)
def test_of_whole_frames_what_is_seen_does_not_depend_on_where_a_body_stands_and_faces(seed):
    reference = find_reference(_walk(seed, "other"))
    walk = _hide_frames(_walk(seed + 1, "walk"))
    moved = _move(walk, seed)
    here, there = find_stance(walk, reference), find_stance(moved, reference)
    np.testing.assert_allclose(there.take_out(moved).values, here.take_out(walk).values, atol=1e-9)


@given(SEEDS)
def test_of_whole_frames_nothing_is_turned_within_a_recording(seed):
    walk = _hide_frames(_walk(seed, "walk"))
    stance = find_stance(walk, find_reference(_walk(seed + 1, "other")))
    complete = walk.visible.all(axis=1)
    steps = np.diff(walk.values[complete][:, :15].reshape(-1, 5, 3), axis=0)
    seen = stance.take_out(walk).values[complete][:, :15].reshape(-1, 5, 3)
    np.testing.assert_allclose(np.diff(seen, axis=0), steps @ stance.rotation.T, atol=1e-9)


@pytest.mark.parametrize("degrees", [0.0, 37.0, 90.0, 180.0])
def test_the_sides_of_a_reference_are_on_the_x_axis(degrees):
    shape = np.array([[0.0, 9.0, 0.0], [-2.0, 5.0, 1.0], [2.0, 5.0, -0.5]])
    names = ("head", "lhand", "rhand")
    channels = tuple(f"{name}.{axis}" for name in names for axis in "xyz")
    values = np.tile(Rotation.from_euler("y", degrees, degrees=True).apply(shape).ravel(), (3, 1))
    reference = find_reference(Recording("r", np.arange(3), values, channels, ("cm",) * 9))
    np.testing.assert_allclose((reference[1] - reference[2])[1:], 0.0, atol=1e-12)
    np.testing.assert_allclose(reference.mean(axis=0), 0.0, atol=1e-12)


def test_without_a_complete_frame_or_three_markers_nothing_is_taken_out():
    walk = _walk(1, "walk")
    hidden = walk.hide(np.ones(walk.values.shape, dtype=bool))
    two = walk.select(CHANNELS[:6])
    for recording in (hidden, two):
        stance = find_stance(recording, find_reference(recording))
        assert stance.take_out(recording) is recording
