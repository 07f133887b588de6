import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import recording
from sklearn.impute import KNNImputer

from mocapbench.baselines.nn import NN


def test_hidden_entries_are_copied_from_the_nearest_frame():
    train = recording("train", [[0.0, 10.0, 1.0], [5.0, 20.0, 2.0]])
    new = recording("new", [[1.0, 13.0, np.nan], [4.0, np.nan, np.nan]])
    filled = NN().fit([train]).impute([new])[0].mean
    np.testing.assert_array_equal(filled, [[1.0, 13.0, 1.0], [4.0, 20.0, 2.0]])


def test_only_frames_that_show_an_entry_donate_it():
    train = recording("train", [[0.0, np.nan, 1.0], [5.0, 20.0, np.nan]])
    filled = NN().fit([train]).impute([recording("new", [[0.0, np.nan, np.nan]])])[0].mean
    np.testing.assert_array_equal(filled, [[0.0, 20.0, 1.0]])


@given(seed=st.integers(0, 2**32 - 1))
def test_frames_that_show_something_are_filled_as_by_scikit_learn(seed):
    rng = np.random.default_rng(seed)
    train = rng.normal(size=(20, 4))
    train[rng.random(train.shape) < 0.2] = np.nan
    train[:, 0] = rng.normal(size=20)
    new = rng.normal(size=(6, 4))
    new[:, 1:][rng.random((6, 3)) < 0.5] = np.nan
    expected = KNNImputer(n_neighbors=1, keep_empty_features=True).fit(train).transform(new)
    filled = NN().fit([recording("train", train)]).impute([recording("new", new)])[0].mean
    np.testing.assert_allclose(filled, expected)


def test_a_frame_with_nothing_visible_is_matched_by_interpolation():
    train = recording("train", np.arange(10.0)[:, None] * [1.0, 100.0])
    new = recording("new", [[0.0, 0.0], [np.nan, np.nan], [np.nan, np.nan], [8.4, 840.0]])
    filled = NN().fit([train]).impute([new])[0].mean
    np.testing.assert_array_equal(filled[1:3], [[3.0, 300.0], [6.0, 600.0]])


@pytest.mark.parametrize(
    "values", [[[np.nan, np.nan]], [[np.nan, 1.0]]], ids=["nothing visible", "no donor"]
)
def test_an_entry_without_a_donor_is_refused(values):
    train = recording("train", [[np.nan, 2.0], [np.nan, 3.0]])
    with pytest.raises(ValueError, match=r"'new': expected a training frame in which \['c0'"):
        NN().fit([train]).impute([recording("new", values)])


def test_weights_stretch_the_distance():
    train = recording("train", [[0.0, 1.0, 5.0], [3.0, 0.0, 7.0]])
    new = recording("new", [[0.0, 0.0, np.nan]])
    expected = {0.5: 5.0, 4.0: 7.0}  # distances 1 and 3 over the second channel's weight
    for weight, value in expected.items():
        weights = {"c0": 1.0, "c1": weight, "c2": 1.0}
        assert NN(weights).fit([train]).impute([new])[0].mean[0, 2] == value


@given(seed=st.integers(0, 2**32 - 1))
def test_weights_undo_a_change_of_units(seed):
    rng = np.random.default_rng(seed)
    train, new, units = rng.normal(size=(20, 4)), rng.normal(size=(6, 4)), rng.uniform(0.1, 9.0, 4)
    new[:, 1:][rng.random((6, 3)) < 0.5] = np.nan
    plain = NN().fit([recording("train", train)]).impute([recording("new", new)])[0].mean
    weights = {f"c{d}": unit for d, unit in enumerate(units)}
    model = NN(weights).fit([recording("train", train / units)])
    scaled = model.impute([recording("new", new / units)])[0].mean
    np.testing.assert_allclose(scaled * units, plain)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        ({"c0": 1.0}, r"a weight of every channel, got none of \['c1'\]"),
        ({"c0": 1.0, "c1": -1.0}, "weights of .* at least 0"),
        ({"c0": 1.0, "c1": np.nan}, "weights of .* at least 0"),
    ],
)
def test_weights_that_are_no_weights_are_refused(weights, message):
    with pytest.raises(ValueError, match=message):
        NN(weights).fit([recording("train", [[0.0, 1.0]])])
