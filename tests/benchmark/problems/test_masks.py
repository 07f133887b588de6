import numpy as np
import pytest

from mocapbench.benchmark import hide_all_but, hide_frames


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
