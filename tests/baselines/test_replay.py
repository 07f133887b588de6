import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.replay import Replay
from mocapbench.datasets import Recording

TIMES = np.linspace(0.0, 1.0, 11)


def recording(name, slope):
    values = np.outer(TIMES, [slope, -slope])
    return Recording(name, TIMES, values, ("a", "b"), ("deg", "deg"))


ONE, TWO = recording("one", 1.0), recording("two", 2.0)


@given(seed=st.integers(0, 2**32 - 1))
def test_every_sample_is_a_recording(seed):
    for sample in Replay().fit([ONE, TWO]).sample(TIMES, 5, seed):
        assert any(np.array_equal(sample, walk.values) for walk in (ONE, TWO))


def test_all_recordings_are_drawn():
    samples = Replay().fit([ONE, TWO]).sample(TIMES, 50, 0)
    assert set(samples[:, -1, 0]) == {1.0, 2.0}


def test_a_line_is_interpolated_through_hidden_entries_and_between_frames():
    hidden = np.zeros((11, 2), dtype=bool)
    hidden[3:6, 1] = True
    between = (TIMES[1:] + TIMES[:-1]) / 2
    (sample,) = Replay().fit([ONE.hide(hidden)]).sample(between, 1, 0)
    np.testing.assert_allclose(sample, np.outer(between, [1.0, -1.0]), atol=1e-12)


def test_a_channel_that_is_never_visible_cannot_be_replayed():
    hidden = np.broadcast_to([False, True], (11, 2))
    with pytest.raises(ValueError, match=r"'two'.*\['b'\]"):
        Replay().fit([ONE, TWO.hide(hidden)])
