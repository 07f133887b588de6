import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.registration import TimeMap, register_affinely
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording

TIMES = np.linspace(0.0, 2.0, 60)


def _movement(times):
    """Two channels that no other shift or pace within reach resembles."""
    return np.column_stack([np.sin(4.0 * times) + times**2, np.cos(5.0 * times)])


def _recording(name, values, times=TIMES):
    return Recording(name, times, values, ("knee", "hip"), ("deg", "deg"))


def _incomplete(seed=0):
    hidden = np.random.default_rng(seed).random((60, 2)) < 0.5
    return _recording("incomplete", _movement(TIMES)).hide(hidden)


@settings(deadline=None, max_examples=10)
@given(st.floats(-0.25, 0.25), st.floats(-0.2, 0.2), st.floats(-5.0, 5.0))
def test_a_shifted_and_slower_copy_is_moved_back(shift, log_pace, offset):
    # The copy shows at time t what the reference shows at (t − a) / b.
    times = np.linspace(-1.5, 4.5, 181)
    copy = _recording("copy", offset + _movement((times - shift) / np.exp(log_pace)), times)
    reference = _incomplete()
    (kept, unmoved), (moved, clock) = register_affinely([reference, copy])
    assert kept is reference
    assert unmoved == TimeMap()
    np.testing.assert_array_equal(moved.times, reference.times)
    np.testing.assert_allclose(moved.values, offset + _movement(TIMES), atol=0.02)
    np.testing.assert_allclose(
        clock.to_recording(TIMES), shift + np.exp(log_pace) * TIMES, atol=0.02
    )
    np.testing.assert_allclose(clock.to_reference(clock.to_recording(TIMES)), TIMES, atol=1e-12)


def test_hidden_entries_do_not_take_part():
    reference = _incomplete()
    wild = reference.with_values(np.where(reference.visible, reference.values, 1e6))
    again = wild.hide(~reference.visible)
    copy = _recording("copy", _movement(TIMES + 0.1))
    both = (register_affinely([shown, copy]) for shown in (reference, again))
    for (one, _), (two, _) in zip(*both, strict=True):
        np.testing.assert_array_equal(one.values, two.values)


def test_incomplete_recordings_and_those_too_short_to_compare_are_left_alone():
    short = _recording("short", _movement(TIMES[:20]), TIMES[:20])
    recordings = [_incomplete(), _recording("other", _movement(TIMES)).hide(TIMES[:, None] < 0.1)]
    given = (*recordings, short)
    assert register_affinely(given) == tuple((each, TimeMap()) for each in given)


def test_complete_recordings_are_moved_onto_the_first():
    first, copy = _recording("first", _movement(TIMES)), _recording("copy", _movement(TIMES + 0.2))
    (kept, _), (moved, _) = register_affinely([first, copy])
    assert kept is first
    visible = moved.visible
    np.testing.assert_allclose(moved.values[visible], first.values[visible], atol=0.02)


def test_a_registered_model_fills_better_and_takes_the_recordings_it_was_given():
    recordings = [_incomplete(), _recording("late", _movement(TIMES + 0.4))]
    hidden = ~recordings[0].visible
    errors = {}
    for registration in ("none", "affine"):
        model = MOHGP(registration=registration, max_iter=30, n_restarts=1).fit(recordings)
        filled, complete = model.impute(recordings)
        np.testing.assert_array_equal(complete.mean, recordings[1].values)
        np.testing.assert_array_equal(complete.variance, 0.0)
        errors[registration] = np.square(filled.mean - _movement(TIMES))[hidden].mean()
    assert errors["affine"] < errors["none"]


@pytest.mark.parametrize("registration", ["none", "affine"])
def test_posteriors_of_a_recording_are_at_its_own_times(registration):
    """The curve of a recording passes through its values, however it was moved."""
    early, late = _incomplete(), _recording("late", _movement(1.1 * TIMES + 0.2))
    model = MOHGP(registration=registration, max_iter=60, n_restarts=1).fit([early, late])
    inside = late.times[10:50]
    draws = model.posterior_draws(late, 50, 0, inside)
    assert np.abs(draws.mean(axis=0) - late.values[10:50]).max() < 0.05
    deviations = np.sqrt(np.diag(model.posterior_covariance(late, inside))).reshape(2, 40).T
    np.testing.assert_allclose(draws.std(axis=0), deviations, rtol=0.5)


def test_an_unknown_registration_is_refused():
    with pytest.raises(ValueError, match="registration"):
        MOHGP(registration="dtw").fit([_incomplete()])
