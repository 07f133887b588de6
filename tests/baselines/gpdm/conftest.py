import numpy as np
import pytest

from mocapbench.baselines.gpdm.dynamics import Markov, Static
from mocapbench.baselines.gpdm.kernels import LinearKernel, RBFKernel, ScaledKernel, SumKernel
from mocapbench.baselines.gpdm.posterior import JointPosterior, PointEstimate
from mocapbench.baselines.gpdm.process import Process

LENGTHS = (7, 5)


def linear_rbf(order):
    return SumKernel(ScaledKernel(RBFKernel(order)), LinearKernel(order))


DYNAMICS = {
    "linear+rbf": Markov(Process(linear_rbf(1))),
    "rbf": Markov(Process(ScaledKernel(RBFKernel()))),
    "linear": Markov(Process(LinearKernel())),
    "second order": Markov(Process(linear_rbf(2)), order=2),
    "velocity": Markov(Process(linear_rbf(1)), carry=1.0),
    "second order velocity": Markov(Process(linear_rbf(2)), order=2, carry=1.0),
    "static": Static(),
}


@pytest.fixture(params=DYNAMICS)
def dynamics(request):
    return DYNAMICS[request.param]


def random_estimate(rng, dynamics, n_frames, n_latent=2, n_channels=4):
    return PointEstimate(
        rng.standard_normal((n_frames, n_latent)),
        dynamics.start + 0.3 * rng.standard_normal(len(dynamics.start)),
        Process(RBFKernel()).start + 0.3 * rng.standard_normal(2),
        rng.uniform(0.5, 2.0, n_channels),
    )


def random_posterior(rng, dynamics, lengths=LENGTHS, weight=1.7):
    y = rng.standard_normal((sum(lengths), 4))
    return JointPosterior(Process(RBFKernel()), dynamics, y, lengths, weight)


def numerical_gradient(function, at, step=1e-6):
    """Return central differences of a scalar function of an array."""
    gradient = np.zeros_like(at)
    for index in np.ndindex(at.shape):
        ahead, behind = at.copy(), at.copy()
        ahead[index] += step
        behind[index] -= step
        gradient[index] = (function(ahead) - function(behind)) / (2 * step)
    return gradient


def relative_error(found, expected):
    return np.linalg.norm(found - expected) / max(np.linalg.norm(expected), 1e-12)
