"""The windows of golf-swings, on real and on generated motion."""

import os

import numpy as np
import pytest

from mocapbench.benchmark.tasks.golf_swings import N_BESIDE, N_HIDDEN, N_WINDOWS

needs_recordings = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]


@pytest.mark.parametrize(
    ("case", "lengths"),
    [
        pytest.param("64-02", [63, 71, 63, 59], marks=needs_recordings),
        ("synthetic", [60, 60, 60, 60]),
    ],
)
def test_windows_reach_from_end_to_end_and_the_swing_is_in_no_training(posed, case, lengths):
    hidden = []
    for fold in range(N_WINDOWS):
        problem = posed("golf-swings", case, fold)
        assert [len(problem.given[0].times), *(len(r.times) for r in problem.train)] == lengths
        assert problem.given[0].name not in [recording.name for recording in problem.train]
        frames = np.flatnonzero(~problem.given[0].visible.any(axis=1))
        assert (frames == frames[0] + np.arange(N_HIDDEN)).all()
        hidden.append(frames[0])
    assert hidden[0] == N_BESIDE
    assert hidden[-1] == lengths[0] - N_BESIDE - N_HIDDEN
    assert len(set(hidden)) == N_WINDOWS
