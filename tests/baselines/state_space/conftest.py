"""Random small models and masked sequences, and what the joint Gaussian of all entries says."""

from dataclasses import dataclass

import numpy as np
import pytest

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.linear_gaussian import StateSpaceParameters


def spd(rng, size):
    root = rng.normal(size=(size, size))
    return root @ root.T / size + 0.1 * np.eye(size)


@dataclass
class Exact:
    """The posterior of the states of one sequence, from dense matrices over all its frames."""

    log_likelihood: float
    mean: np.ndarray  # (N, q)
    covariance: np.ndarray  # (N, q, N, q)

    @classmethod
    def of(cls, parameters, sequence):
        n, q = len(sequence), parameters.n_states
        mean, covariance = _states(parameters, n)
        seen = ~np.isnan(sequence).ravel()
        loadings = np.kron(np.eye(n), parameters.loadings)[seen]
        residual = (sequence - parameters.offset).ravel()[seen] - loadings @ mean
        total = loadings @ covariance @ loadings.T + np.diag(np.tile(parameters.noise, n)[seen])
        gain = np.linalg.solve(total, loadings @ covariance).T
        _, log_determinant = np.linalg.slogdet(2 * np.pi * total)
        return cls(
            -0.5 * float(residual @ np.linalg.solve(total, residual) + log_determinant),
            (mean + gain @ residual).reshape(n, q),
            (covariance - gain @ loadings @ covariance).reshape(n, q, n, q),
        )


def _states(parameters, n):
    """Return the prior mean (N q) and covariance (N q, N q) of all states."""
    transition, q = parameters.transition, parameters.n_states
    # x = W (u_1, w_1, …, w_{N-1}) with W[t, s] = A^(t - s) for s ≤ t.
    powers = [np.linalg.matrix_power(transition, t) for t in range(n)]
    blocks = [[powers[t - s] if s <= t else np.zeros((q, q)) for s in range(n)] for t in range(n)]
    spread = np.block(blocks)
    noise = np.kron(np.eye(n), parameters.transition_covariance)
    noise[:q, :q] = parameters.first_covariance
    first = np.zeros(n * q)
    first[:q] = parameters.first[:, 0]
    return spread @ first, spread @ noise @ spread.T


class Problem:
    """Random parameters, and sequences of different lengths with a random mask."""

    def __init__(self, seed, *, lengths=(4, 1, 6), n_states=3, n_channels=2, hidden=0.4):
        rng = np.random.default_rng(seed)
        self.parameters = StateSpaceParameters(
            rng.normal(size=(n_states, 1)),
            spd(rng, n_states),
            0.6 * rng.normal(size=(n_states, n_states)),
            spd(rng, n_states),
            rng.normal(size=(n_channels, 1, n_states + 1)),
            rng.uniform(0.05, 1.0, size=(n_channels, 1, 1)),
        )
        arrays = [rng.normal(size=(n, n_channels)).cumsum(axis=0) for n in lengths]
        self.arrays = [np.where(rng.random(a.shape) < hidden, np.nan, a) for a in arrays]
        self.data = Sequences.of(self.arrays)

    def exact(self):
        return [Exact.of(self.parameters, array) for array in self.arrays]


@pytest.fixture(scope="session")
def pose():
    """Return a random problem for a seed and sizes."""
    return Problem
