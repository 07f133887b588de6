import numpy as np

from mocapbench.baselines.functional.cycles import Cycles


def test_recordings_are_cut_where_the_phase_passes_a_whole_number(waves):
    recordings = waves([30.0, 45.0], n_frames=90).recordings
    phases = [0.5 + np.arange(90) / 30.0, np.arange(90) / 45.0]
    cycles = Cycles.of(recordings, phases, 2)
    assert [len(path) for path in cycles.phases] == [15, 30, 30, 15, 45, 45]
    np.testing.assert_array_equal(cycles.owners, [0, 0, 0, 0, 1, 1])
    np.testing.assert_array_equal(cycles.statistics.counts[:, 0], [15, 30, 30, 15, 45, 45])
    np.testing.assert_array_equal(np.concatenate(cycles.phases), np.concatenate(phases))


def test_a_single_frame_is_a_cycle(waves):
    (recording,) = waves([20.0]).recordings
    cycles = Cycles.of([recording.frames([3])], [np.array([0.2])], 2)
    assert [path.tolist() for path in cycles.phases] == [[0.2]]
