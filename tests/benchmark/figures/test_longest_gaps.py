import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.benchmark import ImputeProblem, Solved, draw_longest_gaps
from mocapbench.datasets import Recording


def solved(gaps, offsets, n_frames=200):
    """Return solutions that are off by a constant each; gaps are (start, stop, column)."""
    times, channels = np.arange(n_frames) / 50.0, ("a", "b", "c", "d")
    values = np.arange(n_frames * 4, dtype=float).reshape(n_frames, 4)
    values[190, 0] = np.nan  # the recording's own gap
    recording = Recording("walk", times, values, channels, ["deg"] * 4)
    hidden = np.zeros(values.shape, dtype=bool)
    for start, stop, column in gaps:
        hidden[start:stop, column] = True
    problem = ImputeProblem.of_one(recording, hidden)
    solutions = {
        label: (Prediction(np.nan_to_num(values) + offset),) for label, offset in offsets.items()
    }
    return Solved("task", problem, solutions)


def test_the_channels_that_lack_most_are_shown_around_their_longest_gap():
    gaps = [(20, 25, 0), (100, 140, 1), (10, 12, 1), (50, 70, 3)]
    (picture,) = draw_longest_gaps(solved(gaps, {"good": 0.1, "bad": 3.0}), n_channels=2)
    assert [panel.title for panel in picture.axes] == ["b", "d"]
    b, d = picture.axes
    assert (b.curves[0].x[0], b.curves[0].x[-1]) == (60 / 50, 179 / 50)
    assert (d.curves[0].x[0], d.curves[0].x[-1]) == (30 / 50, 89 / 50)
    filled = {curve.group: np.isfinite(curve.y).sum() for curve in d.curves}
    assert filled == {"truth": 60, "good": 20, "bad": 20}


def test_the_best_are_shown_best_first_and_the_own_gap_is_not_scored():
    offsets = {"worst": 9.0, "best": 0.0, "second": -1.0}
    (picture,) = draw_longest_gaps(solved([(185, 195, 0)], offsets), n_best=2)
    (panel,) = picture.axes
    assert [curve.group for curve in panel.curves] == ["truth", "best", "second"]


def test_a_long_gap_is_shown_in_part():
    (picture,) = draw_longest_gaps(solved([(0, 3000, 1)], {"one": 1.0}, n_frames=3000))
    assert len(picture.axes[0].curves[0].x) <= 1200
