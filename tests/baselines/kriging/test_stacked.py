import numpy as np

from mocapbench.baselines.kriging.stacked import StackedFrames
from mocapbench.datasets import Recording


def recording(name, values):
    values = np.asarray(values, dtype=float)
    channels = tuple("abc"[: values.shape[1]])
    return Recording(name, np.arange(len(values)) / 30, values, channels, ("",) * len(channels))


NAN = np.nan
ONE = recording("one", np.column_stack([np.arange(9.0), np.zeros(9)]))
TWO = recording("two", [[NAN, NAN], [1.0, NAN], [NAN, NAN], [3.0, NAN]])
FRAMES = StackedFrames.of([ONE, TWO])


def test_hidden_entries_are_interpolated_for_comparison_only():
    middle = FRAMES.windows.shape[1] // 2
    np.testing.assert_allclose(FRAMES.windows[9:, middle], [[1, 0], [1, 0], [2, 0], [3, 0]])
    np.testing.assert_array_equal(FRAMES.values[9:], TWO.values)


def test_windows_end_where_the_recording_does():
    np.testing.assert_array_equal(FRAMES.windows[0, :, 0], [0, 0, 0, 2, 4])
    np.testing.assert_array_equal(FRAMES.windows[8, :, 0], [4, 6, 8, 8, 8])


def test_distances_are_means_of_squared_differences():
    rows, channels = np.array([3, 4, 11]), np.array([0, 1])
    wide = FRAMES.windows[rows].reshape(3, -1)
    expected = ((wide[:, None] - wide) ** 2).mean(axis=2)
    np.testing.assert_allclose(FRAMES.distances(rows, rows, channels), expected, atol=1e-12)
    assert not FRAMES.distances(rows, rows, np.array([], dtype=int)).any()


def test_frames_know_their_recording_and_their_place():
    lags = np.full((3, 4), np.nan)
    for place, between in FRAMES.together(np.array([0, 9, 8]), np.array([8, 10, 0, 3])):
        lags[place] = between
    expected = [[8, NAN, 0, 3], [NAN, 1, NAN, NAN], [0, NAN, 8, 5]]
    np.testing.assert_array_equal(lags, expected)
