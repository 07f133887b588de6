import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.scaling import OwnMeans
from mocapbench.datasets import Recording

NAN = np.nan


def recording(name, values):
    values = np.asarray(values, dtype=float)
    channels = tuple(f"c{d}" for d in range(values.shape[1]))
    return Recording(name, np.arange(float(len(values))), values, channels, ("",) * len(channels))


ONE = recording("one", [[1.0, 5.0], [3.0, NAN]])
OTHER = recording("other", [[11.0, 7.0], [15.0, NAN]])


def test_deviations_are_from_the_recordings_own_means():
    own_means = OwnMeans.of([ONE, OTHER])
    assert own_means.scale[0] == pytest.approx(np.sqrt((1 + 1 + 4 + 4) / 4))
    np.testing.assert_allclose(own_means.apply(ONE)[:, 0] * own_means.scale[0], [-1.0, 1.0])
    np.testing.assert_allclose(own_means.apply(OTHER)[:, 0] * own_means.scale[0], [-2.0, 2.0])


def test_a_channel_without_deviations_has_scale_one():
    assert OwnMeans.of([ONE, OTHER]).scale[1] == 1.0


@given(seed=st.integers(0, 99), hidden=st.floats(0.0, 0.9))
def test_restoring_gives_the_visible_entries_back(seed, hidden):
    rng = np.random.default_rng(seed)
    values = rng.normal(3.0, 2.0, (7, 3))
    truth = recording("r", values)
    given = truth.hide(rng.random((7, 3)) < hidden)
    own_means = OwnMeans.of([truth, given])
    restored = own_means.restore(given, own_means.apply(given))
    np.testing.assert_allclose(restored[given.visible], values[given.visible])


def test_without_a_visible_entry_the_mean_of_all_recordings_stands_in():
    unseen = recording("unseen", [[1.0, NAN]])
    own_means = OwnMeans.of([ONE, OTHER])
    np.testing.assert_allclose(own_means.restore(unseen, np.zeros((1, 2))), [[1.0, 6.0]])
    with pytest.raises(ValueError, match=r"'unseen': expected a visible .* got none of \['c1'\]"):
        OwnMeans.of([unseen]).restore(unseen, np.zeros((1, 2)))
