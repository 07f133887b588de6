from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.channel_kriging import ChannelKriging
from mocapbench.baselines.pca_regression import PCARegression
from mocapbench.datasets import Recording

CHANNELS = ("hip", "knee", "elbow")


def walk(name, start, n_frames=60, offset=0.0, style=0.0):
    """Return a cycle in which the knee is a curved function of hip and elbow."""
    angle = 2 * np.pi * (start + np.arange(n_frames)) / 23.0
    knee = np.abs(np.sin(angle)) + offset + style * np.cos(2 * angle)
    values = np.column_stack([np.sin(angle), knee, np.cos(angle)])
    return Recording(name, np.arange(n_frames) / 30, values, CHANNELS, ("deg",) * 3)


def knee_hidden(recording, first, last=None):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[first:last, 1] = True
    return recording.hide(hidden)


TRAINING = [walk("one", 0), walk("two", 7)]


def error(model, truth, first, last=None):
    recording = knee_hidden(truth, first, last)
    (filled,) = model.fit(TRAINING).impute([recording])
    return np.sqrt(np.mean((filled.mean - truth.values)[~recording.visible] ** 2))


def test_a_curved_relation_is_learnt():
    truth = walk("new", 11)
    assert error(ChannelKriging(), truth, 30) < 0.5 * error(PCARegression(), truth, 30)


def test_what_recordings_have_of_their_own_is_learnt_from_their_visible_part():
    truth = walk("new", 11, offset=0.3, style=0.2)
    hidden_throughout = error(ChannelKriging(), truth, 0)
    assert error(ChannelKriging(), truth, 30) < 0.3 * hidden_throughout


def test_a_drift_is_bridged():
    plain = walk("new", 11)
    drift = np.outer(0.2 * np.sin(np.arange(60) / 8), [0, 1, 0])
    truth = plain.with_values(plain.values + drift)
    assert error(ChannelKriging(), truth, 30, 36) < 0.3 * error(PCARegression(), truth, 30, 36)


def test_whole_frames_are_bridged_smoothly():
    """Nothing describes frames then but when they are."""
    truth = walk("new", 11)
    gap = np.repeat(((np.arange(60) > 30) & (np.arange(60) < 34))[:, None], 3, axis=1)
    (filled,) = ChannelKriging().fit([truth.hide(gap)]).impute([truth.hide(gap)])
    assert np.abs(filled.mean - truth.values).max() < 0.1


def test_one_frame_that_shows_hidden_channels_together_gives_intervals_as_wide_as_they_spread():
    hidden, without_hip = np.zeros((2, 60, 3), dtype=bool)
    hidden[:59, :2] = without_hip[:, 0] = True
    given, other = walk("new", 0).hide(hidden), walk("other", 7)
    others = [other.hide(without_hip), knee_hidden(walk("third", 3), 0)]
    (filled,) = ChannelKriging().fit([given, *others]).impute([given])
    assert (np.sqrt(filled.variance[:50, :2]) > 0.1).all()
    assert (np.sqrt(filled.variance[:50, :2]) < 10.0).all()


@settings(max_examples=10, deadline=None)
@given(st.floats(0.1, 10.0), st.floats(-50.0, 50.0))
def test_the_unit_of_a_channel_does_not_matter(scale, offset):
    def in_unit(recording):
        return recording.with_values(recording.values * scale + offset)

    model = ChannelKriging().fit(TRAINING)
    other = ChannelKriging().fit([in_unit(recording) for recording in TRAINING])
    recording = knee_hidden(walk("new", 11), 30)
    (here,), (there,) = model.impute([recording]), other.impute([in_unit(recording)])
    np.testing.assert_allclose(there.mean, here.mean * scale + offset, atol=1e-6 * (scale + 50))
    np.testing.assert_allclose(there.variance, here.variance * scale**2, rtol=1e-5)


def test_far_from_all_that_was_seen_the_variance_is_larger():
    model = ChannelKriging().fit(TRAINING)
    recording = knee_hidden(walk("new", 11), 30)
    strange = recording.values.copy()
    strange[40:, [0, 2]] += 5.0
    (usual,) = model.impute([recording])
    (unusual,) = model.impute([recording.with_values(strange)])
    assert unusual.variance[50:, 1].mean() > 3.0 * usual.variance[50:, 1].mean()


def test_neither_the_order_of_training_nor_company_matters():
    recordings = [knee_hidden(walk("new", 11), 30), knee_hidden(walk("other", 3), 20, 40)]
    one = ChannelKriging().fit(TRAINING).impute(recordings)
    two = ChannelKriging().fit(TRAINING[::-1]).impute(recordings[::-1])[::-1]
    for here, there in zip(one, two, strict=True):
        np.testing.assert_allclose(here.mean, there.mean, atol=1e-9)


def test_what_cannot_be_filled_is_refused():
    model = ChannelKriging().fit([knee_hidden(walk("one", 0), 0)])
    with pytest.raises(ValueError, match="'knee'"):
        model.impute([knee_hidden(walk("new", 0), 0)])
    with pytest.raises(ValueError, match="expected channels"):
        ChannelKriging().fit(TRAINING).impute([walk("new", 0).select(["hip"])])


def test_channels_that_are_hidden_together_must_be_visible_together_somewhere():
    """Though each of them is visible."""
    apart, throughout = np.zeros((2, 60, 3), dtype=bool)
    apart[:40, 1] = apart[30:, 2] = throughout[:, 1:] = True
    given, training = walk("new", 0).hide(throughout), [walk("one", 0).hide(apart)]
    with pytest.raises(ValueError, match=r"the 2 channels .* \[1, 2\] .* visible, got none"):
        ChannelKriging().fit(training).impute([given])
    (filled,) = ChannelKriging().fit([*training, walk("two", 7)]).impute([given])
    assert np.isfinite(filled.mean).all()


def test_neither_names_nor_order_of_training_change_a_fill():
    """Parameters are learnt from some of the frames alone where training is long."""
    rng = np.random.default_rng(0)
    training = [walk("", 5 * n, 70 + 9 * n, offset=0.1 * n, style=rng.normal()) for n in range(4)]
    new = knee_hidden(walk("new", 11, offset=0.2), 20, 50)
    means = []
    for order in ([0, 1, 2, 3], [3, 1, 0, 2], [2, 3, 1, 0]):
        named = [replace(training[place], name=f"walk {n}") for n, place in enumerate(order)]
        means.append(ChannelKriging().fit(named).impute([new])[0].mean)
    np.testing.assert_array_equal(means[1], means[0])
    np.testing.assert_array_equal(means[2], means[0])
