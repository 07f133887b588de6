"""Channels that are hidden throughout a recording."""

import numpy as np
import pytest
from fixed_variance import FixedVariance
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import FAM, LDS, Calibrated, LowRank
from mocapbench.baselines.calibration.held_out_gaps import hold_out_channels
from mocapbench.baselines.calibration.ways import calibrate
from mocapbench.datasets import Recording

UNITS = ("deg",) * 5 + ("mm",) * 3


def noise(name, scale=1.0, n_frames=100):
    rng = np.random.default_rng([ord(letter) for letter in name])
    values = scale * rng.normal(size=(n_frames, len(UNITS)))
    channels = tuple(f"c{d}" for d in range(len(UNITS)))
    return Recording(name, np.arange(n_frames) / 30, values, channels, UNITS)


def without(recording, lost, gap=slice(0, 0)):
    """Hide channels throughout, and a gap in all."""
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[:, list(lost)] = True
    hidden[gap] = True
    return recording.hide(hidden)


@settings(max_examples=60, deadline=None)
@given(lost=st.sets(st.integers(0, 7), max_size=7))
def test_other_channels_of_the_unit_take_the_place_of_lost_ones(lost):
    units, hidden = np.array(UNITS), np.isin(np.arange(8), [*lost])
    masks = hold_out_channels(without(noise("new"), lost))
    assert len(masks) <= 3
    for mask in masks:
        np.testing.assert_array_equal(mask.any(axis=0), mask.all(axis=0))
        positions = mask.all(axis=0)
        assert not (positions & hidden).any()
        for unit in ("deg", "mm"):
            of_unit = units == unit
            n_shown, n_lost = (of_unit & ~hidden).sum(), (of_unit & hidden).sum()
            assert (positions & of_unit).sum() == min(n_lost, n_shown // 2)


def test_different_channels_are_held_out():
    masks = hold_out_channels(without(noise("new"), [0]))
    assert len({mask.tobytes() for mask in masks}) == 3


@pytest.mark.parametrize("lost", range(8))
def test_as_many_channels_of_the_unit_are_held_out_in_turn_as_there_are_sets(lost):
    n_visible = UNITS.count(UNITS[lost]) - 1
    masks = hold_out_channels(without(noise("new"), [lost]))
    assert np.any(masks, axis=0).all(axis=0).sum() == min(n_visible, 3)


def factors(given, training):
    (before,), (after,) = (
        FixedVariance().impute([given]),
        calibrate(FixedVariance(), training, [given]),
    )
    np.testing.assert_array_equal(after.mean, before.mean)
    hidden = ~given.visible
    return np.where(hidden, after.variance / np.where(hidden, before.variance, 1.0), np.nan)


@settings(max_examples=20, deadline=None)
@given(own=st.floats(1.0, 10.0), there=st.floats(1.0, 10.0))
def test_the_factor_is_the_geometric_mean_of_what_both_show(own, there):
    recording = without(noise("new", own), [1])
    training = [noise(name, there) for name in "abc"]
    masks = np.any(hold_out_channels(recording), axis=0)
    in_channels = np.mean(recording.values[masks] ** 2)
    in_training = np.mean([one.values[:, 1] ** 2 for one in training])
    expected = max(np.sqrt(in_channels * in_training), 1.0)
    np.testing.assert_allclose(factors(recording, training)[:, 1], expected, rtol=1e-9)


def test_variances_are_never_made_smaller():
    training = [noise(name, 0.1) for name in "abc"]
    assert (factors(without(noise("new", 0.1), [1]), training)[:, 1] == 1.0).all()


def test_without_training_to_hold_out_the_recording_alone_decides():
    recording = without(noise("new", 5.0), [1])
    in_channels = np.mean(recording.values[np.any(hold_out_channels(recording), axis=0)] ** 2)
    np.testing.assert_allclose(factors(recording, [recording])[:, 1], in_channels)
    assert in_channels > 4.0


def test_other_gaps_keep_what_their_copies_show():
    training, gap = [noise(name, 3.0) for name in "abc"], slice(40, 50)
    recording = without(noise("new", 3.0), [1], gap)
    (alone,), (both,) = (calibrate(FixedVariance(), known, [recording]) for known in ((), training))
    others = np.arange(8) != 1
    np.testing.assert_array_equal(both.variance[:, others], alone.variance[:, others])
    assert (both.variance[:, 1] > 4.0).all()


def test_a_recording_without_lost_channels_is_left_alone():
    training = [noise(name, 3.0) for name in "abc"]
    recording = without(noise("new", 3.0), [], slice(40, 50))
    (alone,), (both,) = (calibrate(FixedVariance(), known, [recording]) for known in ((), training))
    np.testing.assert_array_equal(both.variance, alone.variance)


def limbs(name, seed):
    """Return angles that follow one swing, each in a way of the person's own."""
    rng, times = np.random.default_rng(seed), np.arange(90) / 30
    own, swings = rng.normal(size=(2, 8)), np.column_stack([np.sin(5 * times), np.cos(5 * times)])
    shared = np.random.default_rng(0).normal(size=(2, 8))
    values = 20 * swings @ (shared + 0.3 * own) + 5 * rng.normal(size=8)
    values += 0.1 * rng.normal(size=values.shape)
    return Recording(name, times, values, tuple("abcdefgh"), ("deg",) * 8)


@pytest.mark.slow
@pytest.mark.parametrize("model", [LDS(), FAM(n_restarts=1, random_state=0), LowRank()])
def test_intervals_of_a_stranger_s_lost_channels_hold_most_of_the_truth(model):
    calibrated, nominal = [], []
    for seed in range(1, 7):
        training = [limbs(f"t{k}", 100 * seed + k) for k in range(4)]
        truth = limbs("new", seed)
        hidden = np.zeros(truth.values.shape, dtype=bool)
        hidden[:, 2:4] = True
        fitted = Calibrated(model).fit(training)
        answers = [one.impute([truth.hide(hidden)])[0] for one in (fitted.model_, fitted)]
        for kept, answer in zip((nominal, calibrated), answers, strict=True):
            off = np.abs(answer.mean - truth.values)[hidden]
            kept.append(np.mean(off < 1.96 * np.sqrt(answer.variance[hidden])))
    assert np.mean(nominal) < 0.75
    assert np.mean(calibrated) > 0.85
