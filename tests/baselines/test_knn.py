from dataclasses import replace

import numpy as np
import pytest
from sklearn.impute import KNNImputer

from mocapbench.baselines.knn import KNN
from mocapbench.datasets import Recording


def recording(name, values, times=None):
    values = np.asarray(values, dtype=float)
    times = np.arange(len(values)) / 10 if times is None else times
    channels = tuple(f"c{d}" for d in range(values.shape[1]))
    return Recording(name, times, values, channels, ("",) * len(channels))


def scattered(rng, name, n):
    values = rng.normal(size=(n, 3)) * [1.0, 5.0, 20.0]
    values[rng.random((n, 3)) < 0.3] = np.nan
    return recording(name, values, np.sort(rng.random(n)))


@pytest.fixture
def pair():
    rng = np.random.default_rng(0)
    return scattered(rng, "a", 30), scattered(rng, "b", 20)


def test_scattered_entries_go_through_scikit_learn_with_a_column_of_time(pair):
    values = np.concatenate([one.values for one in pair])
    times = np.concatenate([one.times for one in pair])
    scale = np.median(np.nanstd(values, axis=0)) / np.std(times)
    expected = KNNImputer(n_neighbors=3).fit_transform(np.column_stack([values, scale * times]))
    filled = KNN(n_neighbors=3).fit(pair).impute(pair)
    np.testing.assert_allclose(np.concatenate([p.mean for p in filled]), expected[:, :3])


def test_a_recording_counts_once_whether_fit_has_seen_it_or_not(pair):
    seen = KNN(n_neighbors=3).fit(pair).impute(pair[1:])[0].mean
    new = KNN(n_neighbors=3).fit(pair[:1]).impute(pair[1:])[0].mean
    np.testing.assert_array_equal(seen, new)


def test_a_hidden_frame_on_a_straight_line_is_found():
    line = np.outer(np.arange(12.0), [1.0, -2.0, 0.5])
    truth = recording("new", line)
    hidden = np.zeros(line.shape, dtype=bool)
    hidden[[0, 4, 5, 6, 11]] = True
    model = KNN(n_neighbors=3).fit([recording("train", line + 3.0)])
    np.testing.assert_allclose(model.impute([truth.hide(hidden)])[0].mean, line, atol=1e-10)


def test_a_gap_is_bridged_by_training_steps_and_not_by_the_straight_line():
    angle = np.arange(120) * 0.2
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    truth = recording("new", circle[:30])
    hidden = np.zeros((30, 2), dtype=bool)
    hidden[10:17] = True
    filled = KNN(n_neighbors=3).fit([recording("train", circle)]).impute([truth.hide(hidden)])[0]
    line = np.linspace(circle[9], circle[17], 9)[1:-1]
    error = np.linalg.norm(filled.mean[10:17] - circle[10:17], axis=1)
    assert error.max() < 0.1 * np.linalg.norm(line - circle[10:17], axis=1).max()


def test_fewer_transitions_than_neighbours_serve_all():
    truth = recording("new", [[0.0], [np.nan], [2.0]])
    filled = KNN().fit([recording("train", [[0.0], [5.0]])]).impute([truth])[0]
    np.testing.assert_allclose(filled.mean[1], 1.0)


def test_recordings_of_one_instant_are_filled():
    frames = [recording("a", [[1.0, 2.0]]), recording("b", [[1.5, np.nan]])]
    assert KNN().fit(frames).impute(frames)[1].mean[0, 1] == 2.0


@pytest.mark.parametrize(
    ("train", "new", "message"),
    [
        ([[1.0, 2.0]], [[np.nan, np.nan]], "two consecutive frames"),
        ([[1.0, 2.0], [2.0, 3.0]], [[np.nan, np.nan]], "'new': expected a visible frame"),
        ([[np.nan, 2.0]], [[np.nan, 1.0]], r"none of \['c0'\]"),
    ],
)
def test_what_cannot_be_filled_is_refused(train, new, message):
    with pytest.raises(ValueError, match=message):
        KNN().fit([recording("train", train)]).impute([recording("new", new)])


def test_it_needs_a_neighbour():
    with pytest.raises(ValueError, match="n_neighbors to be an integer of at least 1"):
        KNN(n_neighbors=0).fit([recording("train", [[1.0]])])


@pytest.mark.parametrize("factor", [1.0 - 3e-13, 1.0 + 1e-13, 1.0 + 7e-13])
def test_neighbours_equally_far_in_time_are_not_chosen_by_rounding(factor):
    rng = np.random.default_rng(0)
    times = np.linspace(0.0, 2.0 * np.pi, 50)
    *train, new = (recording(name, rng.normal(size=(50, 2)), times) for name in "dbcae")
    hidden = rng.random((50, 2)) < 0.9
    stretched = [replace(r, times=factor * times) for r in (*train, new)]
    (one,), (other,) = (
        KNN(n_neighbors=3).fit(group[:-1]).impute([group[-1].hide(hidden)])
        for group in ((*train, new), (*stretched[-2::-1], stretched[-1]))
    )
    np.testing.assert_allclose(one.mean, other.mean, rtol=1e-9)
