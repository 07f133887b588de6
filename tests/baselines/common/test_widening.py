import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import FAM, LDS, ChannelKriging, LowRank, Prediction
from mocapbench.baselines.common.trials import remoteness, trial_masks
from mocapbench.baselines.common.variance_check import VarianceCheck
from mocapbench.baselines.common.widening import Widened, widened
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


class Claiming(Widened):
    """Predicts 0 and claims one variance."""

    def __init__(self, variance=1.0):
        self.variance = variance

    def fit(self, recordings):
        return self

    def as_claimed(self, recordings):
        return [Prediction.around(recording, 0.0, self.variance) for recording in recordings]


@pytest.mark.parametrize("model", [LDS, LowRank, ChannelKriging, FAM])
def test_a_model_claims_the_means_that_it_fills_with(model):
    recording = noise("r", np.array([1.0, 3.0]), 150)
    fitted = model().fit([recording, noise("other", np.array([2.0, 1.0]), 150)])
    (filled,), (claimed,) = fitted.impute([recording]), fitted.as_claimed([recording])
    np.testing.assert_array_equal(filled.mean, claimed.mean)
    assert (filled.variance >= claimed.variance).all()


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(0.1, 10.0), min_size=1, max_size=4), st.floats(0.01, 100.0))
def test_means_stay_and_no_variance_becomes_smaller(scales, variance):
    recording = noise("r", np.array(scales))
    (before,) = Claiming(variance).as_claimed([recording])
    (after,) = widened(Claiming(variance), [recording])
    np.testing.assert_array_equal(after.mean, before.mean)
    assert (after.variance >= before.variance).all()
    assert (after.variance[recording.visible] == 0.0).all()


@pytest.mark.parametrize("scale", [3.0, 30.0])
def test_a_claim_that_is_too_small_becomes_what_trials_show(scale):
    (prediction,) = widened(Claiming(1.0), [noise("r", np.array([scale, scale]))])
    np.testing.assert_allclose(prediction.variance[80:110], scale**2, rtol=0.3)


def test_a_model_that_errs_nowhere_keeps_its_variance():
    (prediction,) = widened(Claiming(1.0), [noise("r", np.zeros(2))])
    np.testing.assert_array_equal(prediction.variance[80:110], 1.0)


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.02, 0.9))
def test_variances_are_finite_whatever_is_visible(seed, share):
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(40, 2))
    complete = Recording("r", np.arange(40) / 30, values, ("a", "b"), ("", ""))
    recording = complete.hide(rng.random(values.shape) > share)
    (prediction,) = widened(Claiming(1.0), [recording])
    assert (prediction.variance[~recording.visible] >= 1.0).all()
    assert np.isfinite(prediction.variance).all()


class Drifting(Widened):
    """Predicts the last visible value, and claims one variance however long a gap is."""

    def fit(self, recordings):
        return self

    def as_claimed(self, recordings):
        return [
            Prediction.around(recording, self.held(recording.values), 1.0)
            for recording in recordings
        ]

    def held(self, values):
        last = np.maximum.accumulate(np.where(np.isnan(values[:, 0]), 0, np.arange(len(values))))
        return values[last]


def walk(n_hidden, n_frames=200, n_channels=40):
    """Return random walks with unit steps, the last frames but ten hidden."""
    values = np.random.default_rng(1).normal(size=(n_frames, n_channels)).cumsum(axis=0)
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[-n_hidden - 10 : -10] = True
    channels = tuple(f"c{d}" for d in range(n_channels))
    full = Recording("r", np.arange(n_frames) / 30, values, channels, ("",) * n_channels)
    return full.hide(hidden)


def test_where_copies_are_shorter_than_the_gap_the_growth_of_errors_goes_on():
    """Squared errors of a random walk grow with the length, those that are claimed do not."""
    recording = walk(120)
    check = VarianceCheck.of(recording)
    hidden = ~recording.visible
    copy, gap = remoteness(hidden | check.copies[0], check.copies[0]), remoteness(hidden, hidden)
    assert copy < gap
    assert 2 * np.sum(check.halves) == np.sum(check.copies)
    (prediction,) = widened(Drifting(), [recording])
    shown = np.mean(
        [
            (recording.values - answer.mean)[mask] ** 2
            for mask, answer in zip(check.copies, Drifting().as_tried(check.trials), strict=False)
        ]
    )
    grown = prediction.variance[hidden].mean() / shown
    np.testing.assert_allclose(grown, (gap / copy) ** 0.6, rtol=0.05)


def test_copies_that_are_as_long_as_the_gap_are_enough():
    assert VarianceCheck.of(walk(20)).halves == []


def test_each_channel_is_checked_by_itself():
    recording = noise("r", np.array([1.0, 10.0]))
    (prediction,) = widened(Claiming(1.0), [recording])
    assert prediction.variance[90, 1] > 3.0 * prediction.variance[90, 0]


def test_a_recording_without_a_trial_keeps_its_variance():
    recording = Recording("r", np.arange(2.0), [[1.0], [np.nan]], ("c",), ("",))
    (prediction,) = widened(Claiming(5.0), [recording])
    assert prediction.variance[1, 0] == 5.0


@pytest.mark.parametrize("model", [LDS, LowRank, FAM])
def test_a_model_learns_anew_for_trials_of_what_it_has_learnt_from(model):
    recording, other = noise("r", np.array([1.0, 3.0]), 150), noise("other", np.array([2.0, 1.0]))
    fitted = model().fit([recording, other])
    trial, stranger = (
        given.hide(trial_masks(given)[0]) for given in (recording, noise("new", np.ones(2)))
    )
    expected = [model().fit([other, trial]).as_claimed([trial]), fitted.as_claimed([stranger])]
    for answer, (alone,) in zip(fitted.as_tried([trial, stranger]), expected, strict=True):
        np.testing.assert_allclose(answer.mean, alone.mean)
        np.testing.assert_allclose(answer.variance, alone.variance)
    assert not np.allclose(fitted.as_claimed([trial])[0].variance, expected[0][0].variance)


def test_neither_order_nor_company_matters():
    recordings = [noise("a", np.array([2.0, 3.0])), noise("bb", np.array([5.0, 1.0]))]
    model = LDS(n_states=2).fit(recordings)
    here = model.impute(recordings)
    there = model.impute(recordings[::-1])[::-1]
    alone = [model.impute([recording])[0] for recording in recordings]
    for one, *others in zip(here, there, alone, strict=True):
        for other in others:
            np.testing.assert_allclose(other.variance, one.variance)
