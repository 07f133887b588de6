"""The linear dynamical system as an estimator: what it fills, refuses and survives."""

import warnings

import numpy as np
import pytest

from mocapbench.baselines import lds
from mocapbench.baselines.calibrated import Calibrated
from mocapbench.baselines.lds import LDS
from mocapbench.datasets import Recording

CHANNELS, UNITS = ("knee.rx", "hip.rx", "hip.ry"), ("deg",) * 3


def walk(name, phase=0.0, *, n_frames=40, scale=(10.0, 300.0, 0.01)):
    angle = 2 * np.pi * np.arange(n_frames) / 16 + phase
    waves = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1.0)])
    return Recording(name, np.arange(n_frames) / 30, 5.0 + waves * scale, CHANNELS, UNITS)


WALKS = [walk("a"), walk("b", 1.0), walk("c", 2.5, n_frames=33)]


def hidden(recording, frames, channels=slice(None)):
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[frames, channels] = True
    return recording.hide(mask)


@pytest.mark.parametrize(
    ("frames", "channels"),
    [
        (slice(10, 22), slice(None)),
        (slice(None), 1),
        (slice(0, 8), 0),
        (slice(30, 40), slice(1, 3)),
    ],
    ids=["whole frames", "a channel", "the start", "the end"],
)
def test_a_new_walk_is_filled_whatever_is_hidden(frames, channels):
    new = walk("new", 4.0)
    given = hidden(new, frames, channels)
    (prediction,) = LDS(2).fit(WALKS).impute([given])
    size = new.values.std(axis=0)
    assert (np.abs(prediction.mean - new.values) / size).max() < 0.35
    assert (np.abs(prediction.mean - new.values) < 4 * np.sqrt(prediction.variance))[
        ~given.visible
    ].all()


def test_the_variance_grows_towards_the_middle_of_a_gap_and_contains_the_noise():
    model = LDS(2).fit(WALKS)
    given = hidden(walk("new"), slice(10, 22))
    (prediction,) = model.impute([given])
    gap = prediction.variance[10:22]
    assert (gap[5:7] > gap[[0, 11]]).all()
    assert (gap > model.parameters_.noise * model.scaling_.scale**2).all()


def test_units_do_not_matter():
    other = [
        walk(w.name, p, n_frames=len(w.times), scale=(1.0, 1.0, 1.0))
        for w, p in zip(WALKS, (0.0, 1.0, 2.5), strict=True)
    ]
    given = hidden(WALKS[0], slice(5, 15))
    (one,) = LDS(2).fit(WALKS).impute([given])
    (two,) = LDS(2).fit(other).impute([hidden(other[0], slice(5, 15))])
    ratio = np.array([10.0, 300.0, 0.01])
    np.testing.assert_allclose(one.mean - 5.0, (two.mean - 5.0) * ratio, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(one.variance, two.variance * ratio**2, rtol=1e-6)


def test_the_order_of_recordings_changes_nothing():
    given = hidden(walk("new", 4.0), slice(10, 20))
    (one,), (two,) = (LDS(2).fit(order).impute([given]) for order in (WALKS, WALKS[::-1]))
    np.testing.assert_array_equal(one.mean, two.mean)


def test_a_recording_is_filled_alike_in_any_company():
    model = LDS(2).fit(WALKS)
    given = [hidden(walk("x", n_frames=12), slice(3, 9)), hidden(walk("y", 1.0), slice(20, 30), 1)]
    together = model.impute(given)
    for recording, prediction in zip(given, together, strict=True):
        (alone,) = model.impute([recording])
        np.testing.assert_allclose(prediction.mean, alone.mean, rtol=1e-9)
        np.testing.assert_allclose(prediction.variance, alone.variance, rtol=1e-9)


def test_samples_oscillate_as_the_recordings_do():
    samples = LDS(2).fit(WALKS).sample(np.arange(160) / 30, 3, random_state=0)
    power = np.abs(np.fft.rfft(samples - samples.mean(axis=1, keepdims=True), axis=1)) ** 2
    assert set(power[:, :, 0].argmax(axis=1)) <= {9, 10, 11}


def test_a_constant_channel_keeps_its_value():
    still = [
        w.with_values(np.column_stack([w.values[:, :2], np.full(len(w.times), 7.0)])) for w in WALKS
    ]
    (prediction,) = LDS(2).fit(still).impute([hidden(still[0], slice(5, 15))])
    np.testing.assert_allclose(prediction.mean[5:15, 2], 7.0, atol=1e-6)
    assert (prediction.variance[5:15, 2] > 0).all()


def test_a_channel_that_nobody_shows_is_refused():
    with pytest.raises(ValueError, match=r"none of \['hip.ry'\]; leave these channels out"):
        LDS().fit([hidden(w, slice(None), 2) for w in WALKS])


def test_recordings_of_one_frame_have_no_dynamics():
    frames = [Recording(f"{k}", [0.0], WALKS[0].values[[k]], CHANNELS, UNITS) for k in range(20)]
    model = LDS(2).fit(frames)
    np.testing.assert_array_equal(model.parameters_.transition, np.zeros((2, 2)))
    (prediction,) = model.impute([hidden(frames[0], 0, 2)])
    assert abs(prediction.mean[0, 2] - WALKS[0].values[0, 2]) < 0.005


def test_a_recording_of_one_channel_and_one_visible_entry():
    single = WALKS[0].select(("knee.rx",))
    (prediction,) = LDS(2).fit([single]).impute([hidden(single, slice(1, 40))])
    assert np.isfinite(prediction.mean).all()
    assert (prediction.variance[1:] > 0).all()


def test_more_states_than_frames_are_reduced_with_a_warning():
    with pytest.warns(UserWarning, match="at least n_states=15 dimensions, got 3"):
        model = LDS().fit([walk("short", n_frames=4)])
    assert model.n_states_ == 3


def test_the_default_raises_no_warning_on_walks_with_noise():
    noise = np.random.default_rng(0).normal(size=(40, 3))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        LDS(max_iter=2).fit([WALKS[0].with_values(WALKS[0].values + noise)])


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"n_states": 0}, "expected n_states to be an integer of at least 1, got 0"),
        ({"max_iter": 1.5}, "expected max_iter to be an integer of at least 1, got 1.5"),
        ({"tol": -1.0}, "expected tol to be a finite positive number, got -1.0"),
    ],
)
def test_bad_parameters_are_refused(parameters, message):
    with pytest.raises(ValueError, match=message):
        LDS(**parameters).fit(WALKS)


def test_other_channels_are_refused():
    with pytest.raises(ValueError, match="expected channels"):
        LDS(2).fit(WALKS).impute([WALKS[0].select(("knee.rx",))])


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.3, 1.0])
def test_intervals_are_hardly_wider_than_the_noise_of_a_recording_that_repeats_itself(noise):
    rng, angle = np.random.default_rng(20), 2 * np.pi * np.arange(600) / 60
    phases = rng.uniform(0.0, 6.0, 6)
    waves = 20 * np.sin(angle[:, None] + phases) + 6 * np.sin(2 * angle[:, None] + 2 * phases)
    values, mask = waves + rng.normal(0.0, noise, waves.shape), np.zeros(waves.shape, dtype=bool)
    for channel, first in enumerate((30, 120, 210, 300, 390, 480)):
        mask[first : first + 30, channel] = True
    whole = Recording("r", np.arange(600) / 60, values, tuple("abcdef"), ("deg",) * 6)
    given = whole.hide(mask)
    model = Calibrated(LDS()).fit([given])
    (nominal,), (prediction,) = model.model_.impute([given]), model.impute([given])
    squares = (prediction.mean - values)[mask] ** 2 / prediction.variance[mask]
    assert 0.6 < squares.mean() < 1.5
    assert prediction.variance[mask].mean() < 0.5 * nominal.variance[mask].mean()


@pytest.mark.parametrize("max_iter", [1, 3, 50])
def test_the_objective_is_that_of_the_start_and_of_each_iteration(max_iter):
    model = LDS(2, max_iter=max_iter, tol=0.1).fit(WALKS)
    assert len(model.objective_) == model.n_iterations_ + 1
    assert model.n_iterations_ <= max_iter
    assert model.converged_ or model.n_iterations_ == max_iter


def test_what_noise_is_shown_is_learnt_once_and_only_where_held_out_gaps_can_narrow(monkeypatch):
    calls, learn = [], lds.show_noise
    monkeypatch.setattr(lds, "show_noise", lambda *given: calls.append(1) or learn(*given))
    model = Calibrated(LDS(2)).fit(WALKS)
    model.impute([walk("complete")])
    assert not calls
    for _ in range(2):
        model.impute([hidden(walk("new", 4.0), slice(10, 12))])
    assert len(calls) == 1
