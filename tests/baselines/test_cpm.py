from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.cpm import CPM
from mocapbench.datasets import Recording


def _walks(n=4):
    rng = np.random.default_rng(0)
    for k in range(n):
        phase = 2.0 * np.pi * (np.arange(40 + k) * (0.9 + 0.05 * k) / 12.0 + rng.random())
        values = 5.0 * np.sin(phase[:, None] * [1, 2] + [0.0, 1.0])
        values += 0.2 * rng.normal(size=values.shape)
        yield Recording(f"w{k}", np.arange(len(values)) / 30, values, ("a", "b"), ("deg", "deg"))


WALKS = tuple(_walks())
RENAMED = tuple(replace(walk, name=f"new {walk.name}") for walk in WALKS)


@pytest.fixture(scope="module")
def fitted():
    return CPM(max_iter=20, n_restarts=2, random_state=0).fit(WALKS)


def test_the_likelihood_rises(fitted):
    rises = np.diff(fitted.log_likelihood_)
    assert (rises >= -1e-9 * np.abs(fitted.log_likelihood_[1:])).all()


def test_frames_resemble_the_states_that_they_are_at(fitted):
    for walk, path in zip(WALKS, fitted.path_, strict=True):
        assert np.sqrt(((walk.values - fitted.trace_[path]) ** 2).mean()) < 1.0
        steps = np.diff(path) % fitted.cycle_length_
        assert ((steps >= 1) & (steps <= 3)).all()


def test_prototypes_of_one_motion_agree_once_warped(fitted):
    assert fitted.prototypes_.shape == (4, fitted.cycle_length_, 2)
    np.testing.assert_allclose(
        fitted.prototypes_, np.broadcast_to(fitted.trace_, fitted.prototypes_.shape), atol=1.5
    )


def test_a_recording_aligns_as_if_fitted_and_order_means_nothing(fitted):
    for path, again in zip(fitted.path_, fitted.align(RENAMED), strict=True):
        distance = np.abs(path - again)
        assert (np.minimum(distance, fitted.cycle_length_ - distance) <= 1).mean() > 0.9
    turned = CPM(max_iter=20, n_restarts=2, random_state=0).fit(WALKS[::-1])
    np.testing.assert_array_equal(turned.path_[0], fitted.path_[-1])


def test_channels_are_checked(fitted):
    with pytest.raises(ValueError, match="expected channels"):
        fitted.align([WALKS[0].select(["a"])])
