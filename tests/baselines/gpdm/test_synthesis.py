"""New recordings from latent dynamics."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.gpdm import synthesis
from mocapbench.baselines.gpdm.model import GPDM
from mocapbench.datasets import Recording


@pytest.fixture(scope="module")
def fitted():
    """Return a second-order model of two recordings, the first too short to start from."""
    angle = 0.5 * np.arange(20)
    values = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1.0)])
    walk = Recording("walk", np.arange(20) / 30, values, ("a", "b", "c"), ("deg",) * 3)
    frame = Recording("frame", np.arange(1) / 30, values[:1], ("a", "b", "c"), ("deg",) * 3)
    return GPDM(n_latent=2, order=2, max_iter=3).fit([frame, walk])


@pytest.fixture(autouse=True)
def short_chains(monkeypatch):
    monkeypatch.setattr(synthesis, "_BURN_IN", 3)
    monkeypatch.setattr(synthesis, "_LEAPS", 3)


@pytest.mark.parametrize("times", [np.arange(6) / 30, np.array([0.01, 0.02, 0.3]), np.zeros(1)])
def test_samples_have_the_times_that_are_given(fitted, times):
    samples = fitted.sample(times, 3, 0)
    assert samples.shape == (3, len(times), 3)
    assert np.isfinite(samples).all()


def test_samples_are_seeded(fitted):
    times = np.arange(5) / 30
    np.testing.assert_array_equal(fitted.sample(times, 2, 1), fitted.sample(times, 2, 1))
    assert not np.array_equal(fitted.sample(times, 2, 1), fitted.sample(times, 2, 2))


def test_walks_start_at_the_first_positions_of_a_sequence_that_is_long_enough(fitted):
    frame, walk = fitted.latent_paths()
    assert len(frame) == 1
    mean, samples = fitted.latent_walks(5, 2, 0)
    for trajectory in (mean, *samples):
        np.testing.assert_array_equal(trajectory[:2], walk[:2])


def test_times_between_frames_are_interpolated(fitted):
    frames = fitted.sample(np.arange(5) / 30, 2, 0)
    between = fitted.sample(np.arange(9) / 60, 2, 0)
    np.testing.assert_allclose(between[:, ::2], frames, atol=1e-9)
    np.testing.assert_allclose(between[:, 1::2], (frames[:, 1:] + frames[:, :-1]) / 2, atol=1e-9)


def test_the_frame_rate_is_that_of_recordings_with_two_frames(fitted):
    assert fitted.frame_seconds_ == pytest.approx(1 / 30)


def test_recordings_of_different_rates_are_refused(fitted):
    frame, walk = fitted.recordings_
    twice = replace(walk, name="twice", times=walk.times / 2)
    for given in ([frame, walk, twice], [walk, frame, twice]):
        with pytest.raises(ValueError, match=r"'twice': expected 30 .* as in 'walk', got 60; res"):
            GPDM().fit(given)


def test_times_span_no_more_frames_than_fit_into_memory(fitted):
    with pytest.raises(ValueError, match=r"expected .* at most 10000 frames .*, got 30000001; "):
        fitted.sample([0.0, 1e6], 1, 0)
