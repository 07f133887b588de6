import numpy as np
import pytest

from mocapbench.benchmark import hide_all_but, hide_frames, hide_runs
from mocapbench.datasets import Recording


@pytest.mark.parametrize("n_visible", [0, 5, 50])
def test_as_many_frames_of_each_channel_are_visible_and_not_the_same(n_visible):
    hidden = hide_all_but(np.random.default_rng(0), n_visible, 50, 4)
    assert hidden.shape == (50, 4)
    assert ((~hidden).sum(axis=0) == n_visible).all()
    if n_visible == 5:
        assert len({tuple(channel) for channel in hidden.T.tolist()}) == 4


def test_whole_frames_are_hidden_from_the_first_to_before_the_last():
    hidden = hide_frames(2, 4, 6, 3)
    assert hidden.tolist() == [[frame in {2, 3}] * 3 for frame in range(6)]


WAVES = Recording("waves", np.arange(6.0), np.zeros((6, 3)), ("a", "b", "c"), ("", "", ""))


def test_each_run_hides_its_channels_for_its_length_and_runs_add_up():
    hidden = hide_runs([(("a", "c"), 1, 2), (("c",), 2, 3)], WAVES)
    assert hidden.T.astype(int).tolist() == [
        [0, 1, 1, 0, 0, 0],
        [0, 0, 0, 0, 0, 0],
        [0, 1, 1, 1, 1, 0],
    ]


@pytest.mark.parametrize("run", [(("a",), -1, 2), (("a",), 5, 2), (("a",), 2, 0), (("d",), 1, 2)])
def test_a_run_beyond_the_recording_is_refused_by_name(run):
    with pytest.raises(ValueError, match="recording 'waves': expected a run of its channels"):
        hide_runs([run], WAVES)
