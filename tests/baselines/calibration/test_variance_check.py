from functools import partial

import numpy as np
import pytest
from fixed_variance import Drifting, FixedVariance
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import FAM, GPLVM, LDS, Calibrated, LowRank
from mocapbench.baselines.calibration.error_ratios import (
    geometric_ratios,
    mean_ratios,
    sum_ratios,
)
from mocapbench.baselines.calibration.held_out_gaps import hold_out_gaps, remoteness
from mocapbench.baselines.calibration.variance_check import STEEPEST, VarianceCheck
from mocapbench.baselines.calibration.ways import calibrate, impute_held_out
from mocapbench.datasets import Recording


def noise(name, scales, n_frames=200):
    """Return white noise with a gap, of one standard deviation for each channel."""
    rng = np.random.default_rng(len(name))
    values = rng.normal(size=(n_frames, len(scales))) * scales
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[80:110] = True
    channels = tuple(f"c{d}" for d in range(len(scales)))
    full = Recording(name, np.arange(n_frames) / 30, values, channels, ("",) * len(channels))
    return full.hide(hidden)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(0.1, 10.0), min_size=1, max_size=4), st.floats(0.01, 100.0))
def test_means_stay_and_variances_are_what_held_out_gaps_show(scales, nominal):
    """Larger where the mean of all sets shows them too small, smaller where each says so."""
    recording, model = noise("r", np.array(scales)), FixedVariance(nominal)
    (before,), (after,) = model.impute([recording]), calibrate(model, (), [recording])
    np.testing.assert_array_equal(after.mean, before.mean)
    assert (after.variance[recording.visible] == 0.0).all()
    mean, worst = ratios(recording, model)
    expected = np.maximum(mean, np.clip(4.0 * worst, 1e-4, 1.0))
    np.testing.assert_allclose(after.variance[90] / nominal, expected)


class Knowing(FixedVariance):
    """Knows how small its variances may be."""

    def __init__(self, variance, least):
        super().__init__(variance)
        self.least = least

    def least_variances(self, recordings):
        return [np.full(recording.values.shape, self.least) for recording in recordings]


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.floats(0.1, 10.0), min_size=1, max_size=4),
    st.floats(0.01, 100.0),
    st.floats(0.01, 100.0),
)
def test_variances_are_as_small_as_held_out_gaps_show_and_the_model_knows(scales, nominal, least):
    """Neither makes them smaller alone, but for those that are more than four times too large."""
    recording, model = noise("r", np.array(scales)), Knowing(nominal, least)
    (without,) = calibrate(FixedVariance(nominal), (), [recording])
    (prediction,) = calibrate(model, (), [recording])
    check = VarianceCheck(recording)
    answers = zip(check.copies, model.impute(check.recordings()), strict=True)
    shown = [mean_ratios(*sum_ratios(recording, mask, answer)) for mask, answer in answers]
    mean, _ = ratios(recording, model)
    both = np.maximum(nominal * np.max([mean, *shown], axis=0), least)
    np.testing.assert_allclose(prediction.variance[90], np.minimum(without.variance[90], both))


@pytest.mark.parametrize("nominal", [10.0, 1e5])
def test_where_copies_are_shorter_what_a_model_knows_makes_no_variance_smaller(nominal):
    recording = walk(80)
    assert (VarianceCheck(recording).steepest > 1.0).all()
    (without,), (prediction,) = (
        calibrate(model, (), [recording])
        for model in (FixedVariance(nominal), Knowing(nominal, 1e-6))
    )
    hidden = ~recording.visible
    np.testing.assert_array_equal(prediction.variance[hidden], without.variance[hidden])


def ratios(recording, model):
    """Return the mean error ratio over the sets, and that of the worst: (D,) each."""
    check = VarianceCheck(recording)
    answers = zip(check.copies, model.impute(check.recordings()), strict=True)
    shown = [sum_ratios(recording, mask, answer) for mask, answer in answers]
    assert len(shown) == 3
    worst = np.max([geometric_ratios(*one) for one in shown], axis=0)
    return mean_ratios(*np.sum(shown, axis=0)), worst


def test_where_copies_are_shorter_variances_keep_room_for_errors_to_grow():
    recording, model = walk(80), Drifting(3.0)
    check, hidden = VarianceCheck(recording), ~recording.visible
    assert len(check.copies) == 3
    assert (check.steepest > 1.0).all()
    answers = zip(check.copies, model.impute(check.recordings()), strict=False)
    shown = [sum_ratios(recording, mask, answer) for mask, answer in answers]
    worst = np.max([geometric_ratios(*one) for one in shown], axis=0)
    expected = np.clip(4.0 * worst * check.steepest, 1e-4, 1.0)
    (before,), (after,) = model.impute([recording]), calibrate(model, (), [recording])
    ratios = after.variance[hidden] / before.variance[hidden]
    factors = np.broadcast_to(expected, hidden.shape)[hidden]
    np.testing.assert_allclose(ratios, factors)
    assert np.median(factors) < 1.0


def test_fewer_than_three_sets_make_no_variance_smaller():
    hidden = np.zeros((60, 1), dtype=bool)
    hidden[8:56] = True
    values = np.sin(np.arange(60.0))[:, None]
    recording = Recording("r", np.arange(60) / 30, values, ("c",), ("",)).hide(hidden)
    assert len(VarianceCheck(recording).copies) == 1
    (prediction,) = calibrate(FixedVariance(1e6), (), [recording])
    np.testing.assert_array_equal(prediction.variance[hidden], 1e6)


def test_a_marker_that_travels_is_not_doubted_by_the_length_of_its_way():
    """`LDS` predicts a share of a channel's spread, but errs no more than if it stayed."""
    times, rng = np.arange(240) / 100, np.random.default_rng(0)
    values = np.column_stack([np.sin(12.6 * times + k) for k in range(4)])
    values += 0.01 * rng.normal(size=values.shape)
    values[:, 0] += 30.0 * times
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[100:130, 0] = True
    given = Recording("r", times, values, tuple("abcd"), ("m",) * 4).hide(hidden)
    model = Calibrated(LDS(n_states=10)).fit([given])
    (nominal,), (prediction,) = model.model_.impute([given]), model.impute([given])
    errors = np.abs(prediction.mean - values)[hidden] / np.sqrt(prediction.variance[hidden])
    assert prediction.variance[hidden].max() < 0.05 * nominal.variance[hidden].max()
    assert errors.max() < 3.0


@given(st.lists(st.floats(1e-6, 1e3), min_size=1, max_size=4), st.integers(1, 50))
def test_geometric_ratios_lie_between_that_of_the_channel_and_that_of_all(ratios, count):
    sums, counts = np.array(ratios) * count, np.full(len(ratios), count)
    moved, pooled = geometric_ratios(sums, counts), np.mean(ratios)
    weight = count / (count + 10)
    expected = weight * np.log(ratios) + (1.0 - weight) * np.log(pooled)
    np.testing.assert_allclose(np.log(moved), expected, atol=1e-9)


def test_one_channel_of_large_variances_is_seen_beside_others_whose_variances_are_right():
    """Their mean is that of the others, its own held-out gaps say otherwise."""
    sums, counts = np.array([40e-4, 40.0, 40.0]), np.full(3, 40)
    assert mean_ratios(sums, counts)[0] > 0.1
    assert geometric_ratios(sums, counts)[0] < 1e-3


@pytest.mark.parametrize("scale", [3.0, 30.0])
def test_a_variance_that_is_too_small_becomes_what_held_out_gaps_show(scale):
    (prediction,) = calibrate(FixedVariance(1.0), (), [noise("r", np.array([scale, scale]))])
    np.testing.assert_allclose(prediction.variance[80:110], scale**2, rtol=0.3)


def test_doubt_does_not_vanish_where_a_model_errs_nowhere():
    (prediction,) = calibrate(FixedVariance(1.0), (), [noise("r", np.zeros(2))])
    np.testing.assert_array_equal(prediction.variance[80:110], 1e-4)


def test_nor_does_it_where_copies_are_shorter():
    still = walk(120)
    still = still.with_values(np.where(still.visible, 0.0, np.nan))
    assert VarianceCheck(still).halves
    (prediction,) = calibrate(FixedVariance(1.0), (), [still])
    np.testing.assert_array_equal(prediction.variance[~still.visible], 1e-4)


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.02, 0.9))
def test_variances_are_finite_whatever_is_visible(seed, share):
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(40, 2))
    complete = Recording("r", np.arange(40) / 30, values, ("a", "b"), ("", ""))
    recording = complete.hide(rng.random(values.shape) > share)
    (prediction,) = calibrate(FixedVariance(1.0), (), [recording])
    assert (prediction.variance[~recording.visible] >= 1e-4).all()
    assert np.isfinite(prediction.variance).all()


def walk(*lengths, n_channels=40):
    """Return random walks with unit steps, each with a gap that ends ten frames before the end."""
    values = np.random.default_rng(1).normal(size=(200, n_channels)).cumsum(axis=0)
    hidden = np.zeros(values.shape, dtype=bool)
    for channel in range(n_channels):
        hidden[190 - lengths[channel % len(lengths)] : 190, channel] = True
    channels = tuple(f"c{d}" for d in range(n_channels))
    full = Recording("r", np.arange(200) / 30, values, channels, ("",) * n_channels)
    return full.hide(hidden)


def shown(recording, model, channels):
    """Return the mean error ratio in copies, and the distances there."""
    check, hidden = VarianceCheck(recording), ~recording.visible
    answers = model.impute([recording.hide(mask) for mask in check.copies])
    ratios = [
        (recording.values - answer.mean)[:, channels] ** 2
        / np.where(mask, answer.variance, 1.0)[:, channels]
        for mask, answer in zip(check.copies, answers, strict=True)
    ]
    masks = [mask[:, channels] for mask in check.copies]
    mean = np.mean(np.concatenate([r[m] for r, m in zip(ratios, masks, strict=True)]))
    copy = max(remoteness(hidden | mask, mask)[channels].max() for mask in check.copies)
    return mean, copy, remoteness(hidden, hidden)[channels].max()


@pytest.mark.parametrize(
    ("power", "least", "most"), [(0.0, 0.6, 0.6), (0.7, 0.1, 0.5), (1.0, 0.0, 0.2)]
)
def test_where_copies_are_shorter_than_the_gap_the_growth_of_errors_goes_on(power, least, most):
    """Squared errors of a random walk grow with the length, and the variance with a power of it."""
    recording, model, every = walk(120), Drifting(power), slice(None)
    mean, copy, gap = shown(recording, model, every)
    assert copy < gap
    (prediction,), (before,) = calibrate(model, (), [recording]), model.impute([recording])
    hidden = ~recording.visible
    factor = (prediction.variance[hidden] / before.variance[hidden]).mean()
    grown = np.log(max(factor, 1.0) / max(mean, 1.0)) / np.log(gap / copy)
    assert least - 0.05 < grown < most + 0.05


def test_growth_is_of_channels_whose_copies_are_short():
    recording, model = walk(4, 120), Drifting()
    alone = walk(4)
    hidden = ~recording.visible
    (both,) = calibrate(model, (), [recording])
    assert VarianceCheck(alone).halves == []
    mean, _, _ = shown(recording, model, slice(0, None, 2))
    of_short_gaps = both.variance[hidden[:, 0], 0].mean()
    pooled = shown(recording, model, slice(None))[0]
    assert of_short_gaps < max(mean, pooled) < both.variance[hidden[:, 1], 1].mean()


def test_copies_that_are_as_long_as_the_gap_are_enough():
    assert VarianceCheck(walk(20)).halves == []


def test_each_channel_is_checked_by_itself():
    recording = noise("r", np.array([1.0, 10.0]))
    (prediction,) = calibrate(FixedVariance(1.0), (), [recording])
    assert prediction.variance[90, 1] > 3.0 * prediction.variance[90, 0]


def test_a_recording_without_held_out_gaps_keeps_its_variance():
    recording = Recording("r", np.arange(2.0), [[1.0], [np.nan]], ("c",), ("",))
    (prediction,) = calibrate(FixedVariance(5.0), (), [recording])
    assert prediction.variance[1, 0] == 5.0


SHORT_SEARCH = {"n_latent": 1, "max_iter": 2, "fill_iter": 2, "random_state": 0}


@pytest.mark.parametrize("model", [LDS, LowRank, FAM, partial(GPLVM, **SHORT_SEARCH)])
def test_a_model_learns_anew_for_gaps_held_out_of_what_it_has_learnt_from(model):
    recording, other = noise("r", np.array([1.0, 3.0]), 150), noise("other", np.array([2.0, 1.0]))
    fitted = model().fit([recording, other])
    shown, stranger = (
        given.hide(hold_out_gaps(given)[0]) for given in (recording, noise("new", np.ones(2)))
    )
    expected = [model().fit([shown, other]).impute([shown]), fitted.impute([stranger])]
    answers = impute_held_out(fitted, [recording, other], [shown, stranger])
    for answer, (alone,) in zip(answers, expected, strict=True):
        np.testing.assert_allclose(answer.mean, alone.mean)
        np.testing.assert_allclose(answer.variance, alone.variance)
    assert not np.allclose(fitted.impute([shown])[0].variance, expected[0][0].variance)


def test_where_too_little_is_left_to_learn_from_the_model_answers_as_learnt():
    """No two of the frames that it leaves follow each other."""
    times = np.arange(14.0)
    values = np.sin(times[:, None] / [3.0, 4.0, 2.0])
    full = Recording("a", times / 30, values, ("a", "b", "c"), ("deg",) * 3)
    given = full.hide(~np.isin(times, [0, 2, 3, 5, 7, 9, 11, 13])[:, None])
    fitted = GPLVM(**SHORT_SEARCH).fit([given])
    shown = given.hide((times == 3)[:, None])
    (held_out,), (nominal,) = impute_held_out(fitted, [given], [shown]), fitted.impute([shown])
    np.testing.assert_array_equal(held_out.mean, nominal.mean)
    assert np.isfinite(calibrate(fitted, [given], [given])[0].variance).all()


def test_neither_order_nor_company_matters():
    recordings = [noise("a", np.array([2.0, 3.0])), noise("bb", np.array([5.0, 1.0]))]
    model = Calibrated(LDS(n_states=2)).fit(recordings)
    here = model.impute(recordings)
    there = model.impute(recordings[::-1])[::-1]
    alone = [model.impute([recording])[0] for recording in recordings]
    for one, *others in zip(here, there, alone, strict=True):
        for other in others:
            np.testing.assert_allclose(other.variance, one.variance)


def test_copies_of_two_frames_are_too_short_to_be_halved_and_shorter_than_the_gap():
    """All of their entries are beside visible ones, as those of a single frame."""
    hidden = np.tile(np.repeat([False, True], 4), 4)[:-4, None]
    values = np.where(hidden, np.nan, 1.0)
    check = VarianceCheck(Recording("r", np.arange(len(values)) / 30, values, ("a",), ("",)))
    assert check.copies
    assert check.halves == []
    np.testing.assert_allclose(check.steepest, 2.0**STEEPEST)
