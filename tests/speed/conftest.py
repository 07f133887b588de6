"""Problems of the sizes that matter, and the naive dense model as the yardstick.

The yardstick forms the covariance of every visible entry of every replicate, factorises it once
(LAPACK potrf, potri) and takes each gradient in one elementwise pass: the textbook way, done well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.linalg import lapack

from mocapbench.baselines.gp.coregionalisation import Coregionalisation
from mocapbench.baselines.gp.kernels import KERNELS, Kernel
from mocapbench.baselines.gp.parameters import CHILD, PARENT, Layer, Parameters
from mocapbench.baselines.gp.reduction import Reduction, hierarchical
from mocapbench.baselines.gp.replicates import Replicates


@dataclass(frozen=True)
class Size:
    """A problem: D outputs, N times, R replicates, Q components; the last ones have a mask."""

    n_outputs: int
    n_times: int
    n_replicates: int
    n_components: int
    kernel: str
    n_visible: int
    n_masked: int = 1


SIZES = {
    "toy D3 R5": Size(3, 50, 5, 3, "rbf", 5),
    "toy D6 R10, one child": Size(6, 50, 10, 3, "rbf", 5),
    "toy D6 R10, all children": Size(6, 50, 10, 3, "rbf", 5, 10),
    "mocap Q1": Size(39, 90, 3, 1, "matern32", 25),
    "mocap Q3": Size(39, 90, 3, 3, "matern32", 25),
}


@dataclass(frozen=True)
class Problem:
    """Data and the point at which the likelihood is evaluated."""

    replicates: Replicates
    parameters: Parameters
    kernel: Kernel

    @property
    def reduction(self) -> Reduction:
        return hierarchical(self.replicates)


def _problem(size: Size) -> Problem:
    rng = np.random.default_rng(0)
    observed = np.ones((size.n_replicates, size.n_outputs, size.n_times), dtype=bool)
    for replicate in observed[size.n_replicates - size.n_masked :]:
        order = rng.permuted(np.tile(np.arange(size.n_times), (size.n_outputs, 1)), axis=1)
        replicate[:] = order < size.n_visible
    data = np.where(observed, rng.standard_normal(observed.shape), 0.0)
    layers = {
        name: Layer(
            rng.uniform(-1.0, 0.0, size.n_components),
            Coregionalisation(
                rng.standard_normal((size.n_components, size.n_outputs, 1)),
                rng.uniform(0.2, 0.5, (size.n_components, size.n_outputs)),
            ),
        )
        for name in (PARENT, CHILD)
    }
    noise = np.full(size.n_outputs, np.log(0.05))
    times = np.linspace(0.0, 2.0 * np.pi, size.n_times)
    return Problem(
        Replicates(times, data, observed), Parameters(layers, noise), KERNELS[size.kernel]
    )


def naive(problem: Problem) -> tuple[float, np.ndarray]:
    """Return the log-likelihood and its gradient in the free coordinates."""
    parameters, kernel = problem.parameters, problem.kernel
    replicate, output, time = np.nonzero(problem.replicates.observed)
    y = problem.replicates.data[problem.replicates.observed]
    lags = np.subtract.outer(problem.replicates.times, problem.replicates.times)
    same = {PARENT: 1.0, CHILD: np.equal.outer(replicate, replicate)}
    points, outputs = np.ix_(time, time), np.ix_(output, output)
    covariance = np.diag(parameters.noise[output])
    for name, layer in parameters.layers.items():
        for b, scale in zip(layer.coregionalisation.matrices, layer.lengthscales, strict=True):
            covariance += same[name] * b[outputs] * kernel.value(lags, scale)[points]
    factor, _ = lapack.dpotrf(covariance, lower=1, overwrite_a=1)
    alpha, _ = lapack.dpotrs(factor, y, lower=1)
    value = -0.5 * y @ alpha - np.log(np.diag(factor)).sum() - 0.5 * len(y) * np.log(2.0 * np.pi)
    inverse, _ = lapack.dpotri(factor, lower=1, overwrite_c=1)
    inverse = np.tril(inverse) + np.tril(inverse, -1).T
    adjoint = 0.5 * (np.outer(alpha, alpha) - inverse)
    starts = np.flatnonzero(np.diff(replicate * len(parameters.noise) + output, prepend=-1))
    leaves = []
    for name, layer in parameters.layers.items():
        own = adjoint * same[name]
        b = layer.coregionalisation
        slopes, weights, roots = [], [], []
        for q, scale in enumerate(layer.lengthscales):
            product = own * kernel.value(lags, scale)[points]
            folded = np.zeros((len(parameters.noise),) * 2)
            blocks = np.add.reduceat(np.add.reduceat(product, starts, axis=0), starts, axis=1)
            np.add.at(folded, np.ix_(output[starts], output[starts]), blocks)
            weights.append(2.0 * folded @ b.weights[q])
            roots.append(2.0 * np.diag(folded) * b.kappa_roots[q])
            slope = b.matrices[q][outputs] * kernel.gradient(lags, scale)[points]
            slopes.append(np.sum(own * slope))
        leaves += [np.array(slopes), np.array(weights).ravel(), np.array(roots).ravel()]
    noise = np.bincount(output, np.diag(adjoint), len(parameters.noise)) * parameters.noise
    return float(value), np.concatenate([*leaves, noise])


@pytest.fixture(scope="session")
def problem() -> Callable[[str], Problem]:
    """Return the problem of a named size."""
    return lambda name: _problem(SIZES[name])


@pytest.fixture(scope="session")
def yardstick() -> Callable[[Problem], tuple[float, np.ndarray]]:
    """The naive model."""
    return naive
