from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.gpdm.conditional import Conditional
from mocapbench.baselines.gpdm.dynamics import Markov, Static
from mocapbench.baselines.gpdm.kernels import LinearKernel, RBFKernel, ScaledKernel, SumKernel
from mocapbench.baselines.gpdm.posterior import KAPPA, JointPosterior, PointEstimate
from mocapbench.baselines.gpdm.regression import log_start

LENGTHS = (7, 5)


def linear_rbf(order):
    return SumKernel(ScaledKernel(RBFKernel(order)), LinearKernel(order))


DYNAMICS = {
    "linear+rbf": Markov(linear_rbf(1)),
    "rbf": Markov(ScaledKernel(RBFKernel())),
    "linear": Markov(LinearKernel()),
    "second order": Markov(linear_rbf(2), order=2),
    "velocity": Markov(linear_rbf(1), carry=1.0),
    "second order velocity": Markov(linear_rbf(2), order=2, carry=1.0),
    "static": Static(),
}


@pytest.fixture(params=DYNAMICS)
def dynamics(request):
    return DYNAMICS[request.param]


def random_estimate(rng, dynamics, n_frames, n_latent=2, n_channels=4):
    return PointEstimate(
        rng.standard_normal((n_frames, n_latent)),
        dynamics.start + 0.3 * rng.standard_normal(len(dynamics.start)),
        log_start(RBFKernel()) + 0.3 * rng.standard_normal(2),
        rng.uniform(0.5, 2.0, n_channels),
    )


def random_posterior(rng, dynamics, lengths=LENGTHS, weight=1.7):
    y = rng.standard_normal((sum(lengths), 4))
    return JointPosterior(RBFKernel(), dynamics, y, lengths, weight)


def numerical_gradient(function, at, step=1e-6):
    """Return central differences of a scalar function of an array."""
    gradient = np.zeros_like(at)
    for index in np.ndindex(at.shape):
        ahead, behind = at.copy(), at.copy()
        ahead[index] += step
        behind[index] -= step
        gradient[index] = (function(ahead) - function(behind)) / (2 * step)
    return gradient


def relative_error(actual, expected):
    return np.linalg.norm(actual - expected) / max(np.linalg.norm(expected), 1e-12)


@pytest.fixture
def conditional():
    """Return the model of two smooth training sequences of seven and five frames, second order."""
    rng, dynamics = np.random.default_rng(0), DYNAMICS["second order"]
    posterior, estimate = smooth_posterior(dynamics)
    noise = 0.01 * rng.standard_normal(estimate.x.shape)
    return Conditional.of(posterior, replace(estimate, x=estimate.x + noise))


def smooth_posterior(dynamics):
    """Return a posterior of poses on a circle, and an estimate with their latent positions."""
    angle = np.concatenate([0.6 * np.arange(length) + 0.45 * length for length in LENGTHS])
    x = np.column_stack([np.sin(angle), np.cos(angle)])
    y = x @ np.array([[1.0, 0.5, -1.0, 0.2], [0.0, 1.0, 0.4, -0.7]])
    posterior = JointPosterior(RBFKernel(), dynamics, y, LENGTHS, weight=2.0)
    start = log_start(RBFKernel())
    return posterior, PointEstimate(x, dynamics.start, start, np.ones(4))


def objective(posterior, estimate):
    """Return the negative log-posterior, the terms in the scales alone included."""
    scales = estimate.scales
    prior = 0.5 * (scales**2).sum() / KAPPA**2 - len(posterior.y) * np.log(scales).sum()
    return posterior.value_and_gradients(estimate)[0] + prior


@pytest.fixture
def posterior():
    return smooth_posterior(DYNAMICS["linear+rbf"])[0]


@pytest.fixture
def start():
    return smooth_posterior(DYNAMICS["linear+rbf"])[1]
