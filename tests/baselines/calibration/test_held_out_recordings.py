"""Variances that held-out gaps and held-out recordings support."""

from itertools import chain
from typing import ClassVar

import numpy as np
import pytest
from fixed_variance import Drifting, FixedVariance, KeepsRecordings
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import Calibrated, ChannelKriging
from mocapbench.baselines.calibration.error_ratios import mean_ratios
from mocapbench.baselines.calibration.held_out_recordings import (
    cut_to_length,
    hold_out_recordings,
)
from mocapbench.baselines.calibration.variance_check import VarianceCheck
from mocapbench.baselines.calibration.ways import calibrate
from mocapbench.baselines.common.recordings import by_content
from mocapbench.datasets import Recording

GAP = slice(80, 110)


class Watched(KeepsRecordings):
    """Keeps the names of what it was fitted to."""

    fits: ClassVar[list[list[str]]] = []

    def fit(self, recordings):
        self.fits.append([recording.name for recording in recordings])
        return self


def noise(name, *scales, n_frames=200):
    """Return white noise of one standard deviation for each channel."""
    rng = np.random.default_rng([ord(letter) for letter in name])
    values = rng.normal(size=(n_frames, len(scales))) * scales
    channels = tuple(f"c{d}" for d in range(len(scales)))
    return Recording(name, np.arange(n_frames) / 30, values, channels, ("",) * len(channels))


def with_gap(recording, gap=GAP):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[gap] = True
    return recording.hide(hidden)


def factor(model, learnt_from, recording):
    """Return by how much the variances of each channel were multiplied."""
    (before,), (after,) = (
        model.impute([recording]),
        calibrate(model, learnt_from, [recording]),
    )
    hidden = ~recording.visible
    np.testing.assert_array_equal(after.mean, before.mean)
    np.testing.assert_array_equal(after.variance[~hidden], 0.0)
    return (after.variance / np.where(hidden, before.variance, 1.0)).max(axis=0)


@pytest.mark.parametrize("nominal", [0.1, 1.0, 20.0])
def test_variances_become_what_held_out_gaps_and_recordings_show(nominal):
    """Channels of one unit move each other's a little."""
    scales = [1.0, 3.0] * 20
    training = [noise(name, *scales) for name in "abcdef"]
    factors = factor(KeepsRecordings(nominal), training, with_gap(noise("new", *scales)))
    means = factors.reshape(-1, 2).mean(axis=0)
    np.testing.assert_allclose(means * nominal, [1.0, 9.0], rtol=0.45)


@settings(max_examples=20, deadline=None)
@given(own=st.floats(0.1, 10.0), there=st.floats(0.1, 10.0))
def test_recording_and_training_count_alike(own, there):
    """The factor is the mean of the two ratios."""
    given, training = with_gap(noise("new", own)), [noise(name, there) for name in "abc"]
    check = VarianceCheck(given)
    in_gaps = check.factors(FixedVariance().impute(check.recordings()))
    errors = [
        cut.values[mask] for r in training for cut, mask in cut_to_length(r, [~given.visible])
    ]
    in_training = mean_ratios(np.array([np.square(errors).sum()]), np.array([np.size(errors)]))
    expected = (in_gaps + in_training) / 2.0
    np.testing.assert_allclose(factor(KeepsRecordings(), training, given), expected)


class Wandering(Drifting):
    """Says that it learns nothing in `fit`."""

    learns_in_fit = False


def walk(name):
    """Return a random walk in many channels."""
    values = np.random.default_rng(len(name)).normal(size=(200, 30)).cumsum(axis=0)
    channels = tuple(f"c{d}" for d in range(30))
    return Recording(name, np.arange(200) / 30, values, channels, ("",) * 30)


def test_errors_grow_from_copies_to_gaps_as_in_training():
    """A random walk has left the last visible value by the number of frames, squared."""
    given = with_gap(walk("new"), slice(60, 180))
    assert VarianceCheck(given).halves
    factors = factor(Wandering(), [walk("w" * number) for number in range(5, 9)], given)
    np.testing.assert_allclose(factors.mean(), np.arange(1, 121).mean(), rtol=0.25)


@pytest.mark.parametrize("training", [[], ["new"], ["a"]])
def test_without_training_to_hold_out_the_recording_alone_decides(training):
    given = with_gap(noise("new", 4.0))
    learnt_from = [given if name == "new" else noise(name, 1.0) for name in training]
    (alone,) = calibrate(FixedVariance(), (), [given])
    (prediction,) = calibrate(KeepsRecordings(), learnt_from, [given])
    np.testing.assert_array_equal(prediction.variance, alone.variance)


def test_a_recording_without_held_out_gaps_keeps_its_variance():
    given = Recording("new", np.arange(2.0), [[1.0], [np.nan]], ("c0",), ("",))
    assert factor(KeepsRecordings(5.0), [noise(name, 1.0) for name in "abc"], given) == 1.0


def test_doubt_does_not_vanish_where_nothing_varies():
    factors = factor(
        KeepsRecordings(), [noise(name, 0.0) for name in "abc"], with_gap(noise("n", 0.0))
    )
    assert factors == pytest.approx(0.01)


class Looking(KeepsRecordings):
    """Keeps what it was asked to fill."""

    seen: ClassVar[list[Recording]] = []

    def impute(self, recordings):
        self.seen.extend(recordings)
        return super().impute(recordings)


def test_training_has_the_gaps_and_a_copy_besides_where_that_is_shorter():
    given, training = with_gap(noise("new", 1.0), slice(40, 160)), [noise(n, 1.0) for n in "abc"]
    check = VarianceCheck(given)
    middle = check.copies[1]
    assert len(check.copies) == 3
    assert (check.steepest > 1.0).all()
    Looking.seen.clear()
    calibrate(Looking(), training, [given])
    for name in "abc":
        gaps, both = [r for r in Looking.seen if r.name == name]
        np.testing.assert_array_equal(gaps.visible, given.visible)
        np.testing.assert_array_equal(both.visible, given.visible & ~middle)


@pytest.mark.parametrize(("n_frames", "says"), [(200, True), (40, True), (25, False)])
def test_a_training_recording_in_which_gaps_are_shorter_says_nothing(n_frames, says):
    given = with_gap(noise("new", 1.0))
    training = [noise(name, 9.0, n_frames=n_frames) for name in "abc"]
    (alone,), (prediction,) = (
        calibrate(FixedVariance(), (), [given]),
        calibrate(KeepsRecordings(), training, [given]),
    )
    assert np.array_equal(prediction.variance, alone.variance) is not says


def test_calm_training_does_not_make_doubt_explode():
    """Clips that begin and end at rest err nowhere in copies there, and much in the gap."""
    rng, still = np.random.default_rng(0), np.ones((200, 1))
    still[:40] = still[160:] = 1e-4
    training = [noise(name, 1.0) for name in "abcdef"]
    resting = [r.with_values(r.values * still) for r in training]
    given = with_gap(noise("new", 1.0).with_values(rng.normal(size=(200, 1))), slice(40, 160))
    assert factor(KeepsRecordings(), resting, given) < 3.0


def test_training_at_rest_beside_the_gap_is_the_limit_of_training_nearly_at_rest():
    """Without any error in copies, errors grow from them to gaps as steeply as they may."""
    given = with_gap(noise("new", 1.0), slice(40, 160))
    factors = []
    for rest in (0.0, 1e-9):
        still = np.full((200, 1), rest)
        still[40:160] = 1.0
        training = [r.with_values(r.values * still) for r in (noise(n, 1.0) for n in "abc")]
        factors.append(factor(KeepsRecordings(), training, given))
    np.testing.assert_allclose(*factors)
    check = VarianceCheck(given)
    own = check.copy_factors(FixedVariance().impute(check.recordings()))
    assert (factors[0] > (check.steepest * own + 0.8) / 2.0).all()


def test_variances_do_not_depend_on_how_large_the_model_says_they_are():
    """Here copies are shorter than gaps, and training varies more in the gaps."""
    wilder = np.ones((200, 1))
    wilder[40:160] = 1.1
    training = [r.with_values(r.values * wilder) for r in (noise(n, 1.0) for n in "abcdef")]
    given = with_gap(noise("new", 1.0), slice(40, 160))
    assert (VarianceCheck(given).steepest > 1.5).all()
    one, *others = (n * factor(KeepsRecordings(n), training, given) for n in (1.0, 0.1, 10.0))
    for other in others:
        np.testing.assert_allclose(other, one)


def test_those_held_out_are_not_learnt_from_and_held_out_at_once_where_many_are_left():
    new, some, many = noise("new", 1.0), "abcd", "abcdefghijklmnop"
    for names, at_once in ((some, False), (many, True)):
        Watched.fits.clear()
        training = by_content([noise(name, 1.0) for name in names])
        expected = [training[place].name for place in (0, len(names) // 2, -1)]
        held_out = [
            [r.name for r in held] for held, _ in hold_out_recordings([*training, new], new)
        ]
        calibrate(Watched(), [*training, new], [with_gap(new)])
        assert (len(held_out) == 1) is at_once
        assert [*chain(*held_out)] == expected
        for learnt, held in zip(Watched.fits, held_out, strict=True):
            assert {*learnt, *held} == {*names, "new"}
            assert not set(learnt) & set(held)


@pytest.mark.parametrize("n_others", [0, 1, 2, 3, 20])
@pytest.mark.parametrize("among", [True, False])
def test_recordings_are_held_out_unless_nobody_would_be_left(n_others, among):
    new, others = (
        noise("new", 1.0),
        [noise(name, 1.0) for name in "abcdefghijklmnopqrst"[:n_others]],
    )
    learnt_from = [*others, new] if among else others
    splits = hold_out_recordings(learnt_from, new)
    assert bool(splits) is (n_others > 0 and len(learnt_from) > 1)
    for held_out, left in splits:
        assert left
        assert new not in held_out
        assert sorted(r.name for r in (*held_out, *left)) == sorted(r.name for r in learnt_from)


@given(st.integers(0, 49), st.integers(1, 10), st.integers(12, 70))
def test_a_recording_is_cut_around_gaps_that_stay_whole(start, length, n_frames):
    """Of the frames that both have, as many on either side as ends allow."""
    mask = np.zeros((50, 1), dtype=bool)
    mask[start : start + length] = True
    recording = noise("r", 1.0, n_frames=n_frames)
    ((cut, kept),) = cut_to_length(recording, [mask])
    assert len(cut.times) == len(kept) == min(n_frames, 50)
    assert kept.sum() == mask.sum()
    (first, *_), before = np.flatnonzero(kept), len(kept) // 2 - length // 2
    nearest = np.clip(before, start + len(kept) - 50, start)
    assert abs(first - nearest) <= 1
    missing = n_frames - len(kept)
    assert cut.times[0] == recording.times[missing // 2]


def test_a_channel_that_one_training_recording_alone_shows_does_no_harm():
    one, two = noise("one", 1.0, 1.0), noise("two", 1.0, 1.0)
    missing = np.zeros((200, 2), dtype=bool)
    missing[:, 1] = True
    given = with_gap(noise("new", 1.0, 1.0), slice(50, 60)).hide(missing)
    model = Calibrated(ChannelKriging()).fit([one, two.hide(missing)])
    (prediction,) = model.impute([given])
    assert np.isfinite(prediction.variance).all()
    assert (prediction.variance[~given.visible] > 0.0).all()


def test_errors_never_shrink_from_copies_to_gaps():
    """Training that stands still in the gap halves the variances, and makes them no less."""
    still = np.ones((200, 1))
    still[40:160] = 1e-4
    training = [r.with_values(r.values * still) for r in (noise(name, 1.0) for name in "abcdef")]
    given = with_gap(noise("new", 1.0), slice(40, 160))
    check = VarianceCheck(given)
    assert (check.steepest > 1.0).all()
    (own,) = check.copy_factors(FixedVariance().impute(check.recordings()))
    assert factor(KeepsRecordings(), training, given) == pytest.approx(own / 2.0, rel=0.1)
