import numpy as np
import pytest

from mocapbench.baselines.kriging.stacked import (
    describe_by_channels,
    stack_frames,
    weigh_channels,
)
from mocapbench.datasets import Recording


def recording(name, values):
    values = np.asarray(values, dtype=float)
    channels = tuple("abc"[: values.shape[1]])
    return Recording(name, np.arange(len(values)) / 30, values, channels, ("",) * len(channels))


NAN = np.nan
ONE = recording("one", np.column_stack([np.arange(9.0), np.zeros(9)]))
TWO = recording("two", [[NAN, NAN], [1.0, NAN], [NAN, NAN], [3.0, NAN]])
VALUES, FRAMES = stack_frames([ONE, TWO])
WINDOWS = FRAMES.description


def test_hidden_entries_are_interpolated_for_comparison_only():
    middle = WINDOWS.shape[1] // 2
    np.testing.assert_allclose(WINDOWS[9:, middle], [[1, 0], [1, 0], [2, 0], [3, 0]])
    np.testing.assert_array_equal(VALUES[9:], TWO.values)


def test_windows_end_where_the_recording_does():
    np.testing.assert_array_equal(WINDOWS[0, :, 0], [0, 0, 0, 4, 8])
    np.testing.assert_array_equal(WINDOWS[8, :, 0], [0, 4, 8, 8, 8])


def test_frames_are_described_by_their_weighted_windows():
    """Such that squared distances are means."""
    rows, channels, weights = np.array([3, 4, 11]), np.array([1, 0]), np.array([0.5, 2.0])
    described = describe_by_channels(FRAMES.at(rows), channels, weights).description
    wide = (WINDOWS[rows][:, :, channels] * weights).reshape(3, -1)
    expected = ((wide[:, None] - wide) ** 2).mean(axis=2)
    distances = ((described[:, None] - described) ** 2).sum(axis=2)
    np.testing.assert_allclose(distances, expected, atol=1e-12)
    none = describe_by_channels(FRAMES.at(rows), np.array([], dtype=int), np.array([]))
    np.testing.assert_array_equal(none.description, np.zeros((3, 1)))


def test_channels_that_say_more_count_more():
    rng = np.random.default_rng(0)
    values = rng.normal(size=(200, 3))
    values[:, 2] = values[:, 0] + 0.1 * rng.normal(size=200)
    _, frames = stack_frames([recording("one", values)])
    windows, last = frames.description, np.array([2])
    relevance = weigh_channels(values, windows, last, np.array([0, 1]))
    assert relevance[0] > 5.0 * relevance[1] > 0.0
    assert np.mean(relevance**2) == pytest.approx(1.0)
    assert not weigh_channels(values, windows, last, np.array([], dtype=int)).size


def test_frames_know_their_recording_and_their_place():
    np.testing.assert_array_equal(FRAMES.recording, [0] * 9 + [1] * 4)
    np.testing.assert_array_equal(FRAMES.times, [*range(9), *range(4)])
