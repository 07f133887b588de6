import numpy as np

from mocapbench.baselines.functional.phases import cut_cycles


def test_recordings_are_cut_where_the_phase_passes_a_whole_number(waves):
    recordings = waves([30.0, 45.0], n_frames=90).recordings
    phases = [0.5 + np.arange(90) / 30.0, np.arange(90) / 45.0]
    curves, owners = cut_cycles(recordings, phases)
    assert [len(path) for path, _ in curves] == [15, 30, 30, 15, 45, 45]
    np.testing.assert_array_equal(owners, [0, 0, 0, 0, 1, 1])
    found, values = (np.concatenate(part) for part in zip(*curves, strict=True))
    np.testing.assert_array_equal(found, np.concatenate(phases))
    np.testing.assert_array_equal(values, np.concatenate([one.values for one in recordings]))


def test_a_single_frame_is_a_cycle(waves):
    (recording,) = waves([20.0]).recordings
    curves, _ = cut_cycles([recording.frames([3])], [np.array([0.2])])
    assert [path.tolist() for path, _ in curves] == [[0.2]]
