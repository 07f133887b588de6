import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import recording

from mocapbench.baselines.aligned_window import AlignedWindow

SCALES = np.arange(0.75, 1.351, 0.05)


def hide(truth, *frames):
    hidden = np.isin(np.arange(len(truth.times)), frames)
    return truth.hide(np.repeat(hidden[:, None], truth.values.shape[1], axis=1))


def brute_force(train, given, gap, n_windows):
    """Try every window frame by frame; one gap away from the ends."""
    first, length = gap[0] - 3, len(gap) + 6
    context = [0, 1, 2, length - 3, length - 2, length - 1]
    windows = []
    for scale in SCALES:
        for values in train:
            index = np.arange(len(values))
            start = 0
            while start + scale * (length - 1) <= len(values) - 1 + 1e-9:
                places = start + scale * np.arange(length)
                window = np.column_stack([np.interp(places, index, c) for c in values.T])
                error = np.sum((window - given[first : first + length])[context] ** 2)
                windows.append((error, window[3:-3]))
                start += 1
    windows.sort(key=lambda pair: pair[0])
    return np.mean([window for _, window in windows[:n_windows]], axis=0)


@given(seed=st.integers(0, 2**32 - 1), n_hidden=st.integers(1, 6))
def test_it_is_the_mean_of_the_best_windows_by_brute_force(seed, n_hidden):
    rng = np.random.default_rng(seed)
    train = [rng.normal(size=(n, 3)) for n in (9, 14, 21)]
    truth = recording("new", rng.normal(size=(20, 3)))
    gap = np.arange(5, 5 + n_hidden)
    model = AlignedWindow(n_windows=4).fit([recording(f"t{i}", v) for i, v in enumerate(train)])
    filled = model.impute([hide(truth, *gap)])[0].mean
    np.testing.assert_allclose(filled[gap], brute_force(train, truth.values, gap, 4))


@pytest.mark.parametrize("scale", [0.75, 1.0, 1.35])
def test_a_motion_seen_at_another_tempo_is_found(scale):
    frames = np.arange(60.0)
    sawtooth = np.column_stack([frames % 20, (frames + 10) % 20])
    places = 6 + scale * (np.arange(14) - 2)  # the window begins two frames in
    truth = recording("new", np.column_stack([np.interp(places, frames, c) for c in sawtooth.T]))
    model = AlignedWindow(n_windows=1).fit([recording("train", sawtooth)])
    filled = model.impute([hide(truth, 5, 6, 7, 8)])[0].mean
    np.testing.assert_allclose(filled, truth.values, atol=1e-9)


@pytest.mark.parametrize("gap", [(0, 1, 2), (17, 18, 19)], ids=["first", "last"])
def test_a_gap_at_an_end_is_matched_on_the_side_there_is(gap):
    values = np.random.default_rng(0).normal(size=(20, 2))
    truth = recording("new", values)
    model = AlignedWindow(n_windows=1).fit([recording("train", values)])
    np.testing.assert_allclose(model.impute([hide(truth, *gap)])[0].mean, values)


def test_gaps_near_each_other_are_matched_on_what_is_visible():
    values = np.random.default_rng(1).normal(size=(30, 2))
    truth = recording("new", values)
    model = AlignedWindow(n_windows=1).fit([recording("train", values)])
    filled = model.impute([hide(truth, 8, 9, 12, 13, 14, 16)])[0].mean
    np.testing.assert_allclose(filled, values)


def test_windows_do_not_cross_hidden_frames_of_training():
    values = np.random.default_rng(2).normal(size=(40, 2))
    broken = hide(recording("train", values), 19)
    halves = [recording("left", values[:19]), recording("right", values[20:])]
    target = [hide(recording("new", values[10:30]), 8, 9, 10)]
    np.testing.assert_allclose(
        AlignedWindow().fit([broken]).impute(target)[0].mean,
        AlignedWindow().fit(halves).impute(target)[0].mean,
    )


def test_what_it_refuses():
    new = recording("new", np.zeros((20, 2)))
    model = AlignedWindow().fit([recording("train", np.zeros((8, 2)))])
    with pytest.raises(ValueError, match="stretch of 10 frames for a window of 12, got 8"):
        model.impute([hide(new, *range(5, 11))])
    with pytest.raises(ValueError, match="'new': expected a visible frame beside frames 0 to 19"):
        model.impute([hide(new, *range(20))])
    with pytest.raises(ValueError, match="1 hidden in part"):
        model.impute([new.hide(np.eye(20, 2, dtype=bool) & [True, False])])
    with pytest.raises(ValueError, match="n_windows to be an integer of at least 1"):
        AlignedWindow(n_windows=0).fit([new])
