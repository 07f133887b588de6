"""Outcomes to score."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from mocapbench.metrics import (
    Clustering,
    Imputation,
    ImputedPoses,
    Recovery,
    SampledPoses,
    Synthesis,
)

CHAIN = ("root", "knee", "lfoot")
PARENTS = (-1, 0, 1)


def poses(truth, mean=None, hidden=None, times=None, starts=(0,)):
    """Joints (N, 3, 3) of the chain; by default all but the root are hidden, and well filled."""
    truth = np.asarray(truth, dtype=float)
    if hidden is None:
        hidden = np.tile([False, True, True], (len(truth), 1))
    return ImputedPoses(
        truth=truth,
        mean=truth if mean is None else np.where(hidden[..., None], mean, truth),
        hidden=hidden,
        hidden_relative=hidden & [False, True, True],
        joints=CHAIN,
        parents=PARENTS,
        times=np.arange(len(truth)) / 30.0 if times is None else times,
        starts=starts,
    )


def drawn_poses(n_frames):
    """Steps too small for a foot to leave the ground, filled with others."""
    rng = np.random.default_rng(0)
    truth, mean = rng.normal(scale=0.1, size=(2, n_frames, 3, 3))
    return poses(truth, mean)


def imputation(truth, mean, variance=None, hidden=None, **visible):
    truth = np.asarray(truth, dtype=float)
    if variance is not None:
        variance = np.broadcast_to(np.asarray(variance, dtype=float), truth.shape)
    return Imputation(
        truth=truth,
        mean=np.broadcast_to(np.asarray(mean, dtype=float), truth.shape),
        variance=variance,
        hidden=np.ones(truth.shape, dtype=bool) if hidden is None else np.asarray(hidden),
        visible_mean=np.asarray(visible.get("visible_mean", np.zeros(truth.shape[-1]))),
        visible_variance=np.asarray(visible.get("visible_variance", np.ones(truth.shape[-1]))),
        scales=np.ones(truth.shape[-1]),
        units=visible.get("units", (("deg", "") * truth.shape[-1])[: truth.shape[-1]]),
        place_joints=partial(drawn_poses, len(truth)),
    )


@pytest.fixture(scope="session")
def make() -> Callable[..., Imputation]:
    """Build an `Imputation`: by default all entries hidden, visible mean 0 and variance 1.

    The scales of all outputs are 1.
    """
    return imputation


@pytest.fixture(scope="session")
def pose(make) -> Callable[..., Imputation]:
    """Build an `Imputation` of four outputs with the poses of a chain of three joints."""

    def pose(truth, mean=None, hidden=None, times=None, starts=(0,)):
        placed = poses(truth, mean, hidden, times, starts)
        values = np.zeros((len(placed.times), 4))
        return replace(make(values, values), units=("cm",) * 4, place_joints=lambda: placed)

    return pose


@pytest.fixture(scope="session")
def place() -> Callable[..., Synthesis]:
    """Build a `Synthesis` whose outputs are the coordinates of a chain of three joints."""

    def place(samples, references, times=None):
        samples, references = (np.asarray(each, dtype=float) for each in (samples, references))
        times = np.arange(samples.shape[1]) / 30.0 if times is None else times
        placed = SampledPoses(samples, references, CHAIN, times)
        values = (each.reshape(*each.shape[:2], 9) for each in (samples, references))
        return Synthesis(*values, lambda: placed)

    return place


@pytest.fixture(scope="session")
def draw(make) -> Callable[..., Imputation]:
    """Draw an outcome with a random mask, every output hidden and visible somewhere."""

    def draw(seed: int, n_frames: int = 12, n_outputs: int = 4) -> Imputation:
        rng = np.random.default_rng(seed)
        shape = (n_frames, n_outputs)
        hidden = rng.random(shape) < 0.5
        hidden[:3], hidden[-1] = True, False
        return make(
            rng.normal(size=shape),
            rng.normal(size=shape),
            np.where(hidden, rng.uniform(0.2, 2.0, shape), 0.0),
            hidden,
            visible_mean=rng.normal(size=n_outputs),
            visible_variance=rng.uniform(0.5, 2.0, n_outputs),
        )

    return draw


@pytest.fixture
def outcomes(draw, place):
    """Return an outcome of each kind."""
    rng = np.random.default_rng(0)
    synthesis = place(rng.normal(size=(3, 8, 3, 3)), rng.normal(size=(4, 8, 3, 3)))
    clustering = Clustering(rng.integers(3, size=9), rng.integers(4, size=9))
    recovery = Recovery(*(dict.fromkeys(("parent", "child"), c * np.eye(3)) for c in (1, 2)), 0.1)
    kinds = (Imputation, Synthesis, Clustering, Recovery)
    return dict(zip(kinds, (draw(0), synthesis, clustering, recovery), strict=True))
