"""Variances that trials and training recordings in the place of the one to fill bear out."""

from dataclasses import replace
from itertools import chain
from typing import ClassVar

import numpy as np
import pytest
from claiming import Claiming, Drifting
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import ChannelKriging
from mocapbench.baselines.rehearsal.ratios import mean_ratios
from mocapbench.baselines.rehearsal.rehearsing import rehearsed
from mocapbench.baselines.rehearsal.stand_ins import aligned, turns
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.baselines.rehearsal.widening import widened
from mocapbench.datasets import Recording

GAP = slice(80, 110)


class Watched(Claiming):
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
        model.as_claimed([recording]),
        rehearsed(model, [recording], learnt_from=learnt_from),
    )
    hidden = ~recording.visible
    np.testing.assert_array_equal(after.mean, before.mean)
    np.testing.assert_array_equal(after.variance[~hidden], 0.0)
    return (after.variance / np.where(hidden, before.variance, 1.0)).max(axis=0)


@pytest.mark.parametrize("claimed", [0.1, 1.0, 20.0])
def test_claims_become_what_trials_and_training_show(claimed):
    training = [noise(name, 1.0, 3.0) for name in "abcdef"]
    factors = factor(Claiming(claimed), training, with_gap(noise("new", 1.0, 3.0)))
    np.testing.assert_allclose(factors * claimed, [1.0, 9.0], rtol=0.3)


@settings(max_examples=20, deadline=None)
@given(own=st.floats(0.1, 10.0), there=st.floats(0.1, 10.0))
def test_recording_and_training_count_alike(own, there):
    """The factor is the mean of the two ratios."""
    given, training = with_gap(noise("new", own)), [noise(name, there) for name in "abc"]
    check = VarianceCheck.of(given)
    in_trials = check.factors(Claiming().as_claimed(check.trials()))
    errors = [cut.values[mask] for r in training for cut, mask in aligned(r, [~given.visible])]
    in_training = mean_ratios(np.array([np.square(errors).sum()]), np.array([np.size(errors)]))
    expected = (in_trials + in_training) / 2.0
    np.testing.assert_allclose(factor(Claiming(), training, given), expected)


def test_a_model_claims_the_means_that_it_fills_with():
    given = with_gap(noise("new", 1.0, 3.0))
    training = [noise(name, 1.0, 3.0) for name in "ab"]
    model = ChannelKriging().fit(training)
    expected = model.as_claimed([given])[0].variance * factor(model, training, given)
    np.testing.assert_allclose(model.impute([given])[0].variance, expected)


def walk(name):
    """Return a random walk in many channels."""
    values = np.random.default_rng(len(name)).normal(size=(200, 30)).cumsum(axis=0)
    channels = tuple(f"c{d}" for d in range(30))
    return Recording(name, np.arange(200) / 30, values, channels, ("",) * 30)


def test_errors_grow_from_copies_to_gaps_as_in_training():
    """A random walk has left the last visible value by the number of frames, squared."""
    given = with_gap(walk("new"), slice(60, 180))
    assert VarianceCheck.of(given).halves
    factors = factor(Drifting(), [walk("w" * number) for number in range(5, 9)], given)
    np.testing.assert_allclose(factors.mean(), np.arange(1, 121).mean(), rtol=0.25)


@pytest.mark.parametrize("training", [[], ["new"], ["a"]])
def test_without_training_to_hold_out_the_recording_alone_decides(training):
    given = with_gap(noise("new", 4.0))
    learnt_from = [given if name == "new" else noise(name, 1.0) for name in training]
    (alone,) = widened(Claiming(), [given])
    (prediction,) = rehearsed(Claiming(), [given], learnt_from=learnt_from)
    np.testing.assert_array_equal(prediction.variance, alone.variance)


def test_a_recording_without_a_trial_keeps_its_variance():
    given = Recording("new", np.arange(2.0), [[1.0], [np.nan]], ("c0",), ("",))
    assert factor(Claiming(5.0), [noise(name, 1.0) for name in "abc"], given) == 1.0


def test_doubt_does_not_vanish_where_nothing_varies():
    factors = factor(Claiming(), [noise(name, 0.0) for name in "abc"], with_gap(noise("n", 0.0)))
    assert factors == pytest.approx(0.01)


class Looking(Claiming):
    """Keeps what it was asked to fill."""

    seen: ClassVar[list[Recording]] = []

    def as_claimed(self, recordings):
        self.seen.extend(recordings)
        return super().as_claimed(recordings)


def test_training_has_the_gaps_and_a_copy_besides_where_that_is_shorter():
    given, training = with_gap(noise("new", 1.0), slice(40, 160)), [noise(n, 1.0) for n in "abc"]
    check = VarianceCheck.of(given)
    middle = check.copies[1]
    assert len(check.copies) == 3
    assert (check.steepest > 1.0).all()
    Looking.seen.clear()
    rehearsed(Looking(), [given], learnt_from=training)
    for name in "abc":
        gaps, both = [r for r in Looking.seen if r.name == name]
        np.testing.assert_array_equal(gaps.visible, given.visible)
        np.testing.assert_array_equal(both.visible, given.visible & ~middle)


@pytest.mark.parametrize(("n_frames", "says"), [(200, True), (40, True), (25, False)])
def test_a_training_recording_in_which_gaps_are_shorter_says_nothing(n_frames, says):
    given = with_gap(noise("new", 1.0))
    training = [noise(name, 9.0, n_frames=n_frames) for name in "abc"]
    (alone,), (prediction,) = (
        widened(Claiming(), [given]),
        rehearsed(Claiming(), [given], learnt_from=training),
    )
    assert np.array_equal(prediction.variance, alone.variance) is not says


def test_calm_training_does_not_make_doubt_explode():
    """Clips that begin and end at rest err nowhere in copies there, and much in the gap."""
    rng, still = np.random.default_rng(0), np.ones((200, 1))
    still[:40] = still[160:] = 1e-4
    training = [noise(name, 1.0) for name in "abcdef"]
    resting = [r.with_values(r.values * still) for r in training]
    given = with_gap(noise("new", 1.0).with_values(rng.normal(size=(200, 1))), slice(40, 160))
    assert factor(Claiming(), resting, given) < 3.0


def test_those_held_out_are_not_learnt_from_and_share_a_turn_where_many_are_left():
    new, some, many = noise("new", 1.0), "abcd", "abcdefghijklmnop"
    for names, shared in ((some, False), (many, True)):
        Watched.fits.clear()
        training = [noise(name, 1.0) for name in names]
        held_out = [[r.name for r in turn] for turn, _ in turns([*training, new], new)]
        rehearsed(Watched(), [with_gap(new)], learnt_from=[*training, new])
        assert (len(held_out) == 1) is shared
        assert [*chain(*held_out)] == [names[0], names[len(names) // 2], names[-1]]
        for learnt, turn in zip(Watched.fits, held_out, strict=True):
            assert {*learnt, *turn} == {*names, "new"}
            assert not set(learnt) & set(turn)


def test_a_channel_that_one_training_recording_alone_shows_does_no_harm():
    one, two = noise("one", 1.0, 1.0), noise("two", 1.0, 1.0)
    missing = np.zeros((200, 2), dtype=bool)
    missing[:, 1] = True
    given = with_gap(noise("new", 1.0, 1.0), slice(50, 60)).hide(missing)
    model = ChannelKriging().fit([one, two.hide(missing)])
    (prediction,) = model.impute([given])
    assert np.isfinite(prediction.variance).all()
    assert (prediction.variance[~given.visible] > 0.0).all()


def test_errors_never_shrink_from_copies_to_gaps():
    """Training that stands still in the gap halves the claims, and makes them no less."""
    still = np.ones((200, 1))
    still[40:160] = 1e-4
    training = [r.with_values(r.values * still) for r in (noise(name, 1.0) for name in "abcdef")]
    given = with_gap(noise("new", 1.0), slice(40, 160))
    check = VarianceCheck.of(given)
    assert (check.steepest > 1.0).all()
    check = replace(check, halves=[])
    (own,) = check.factors(Claiming().as_claimed(check.trials()))
    assert factor(Claiming(), training, given) == pytest.approx(own / 2.0, rel=0.1)
