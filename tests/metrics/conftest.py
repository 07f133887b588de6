"""Outcomes to score."""

from collections.abc import Callable

import numpy as np
import pytest

from mocapbench.metrics import Imputation


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
    )


@pytest.fixture(scope="session")
def make() -> Callable[..., Imputation]:
    """Build an `Imputation`: by default all entries hidden, visible mean 0 and variance 1.

    The scales of all outputs are 1.
    """
    return imputation


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
