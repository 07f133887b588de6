"""The yardstick: the naive dense model.

It forms the covariance of every visible entry of every replicate, factorises it once (LAPACK
potrf, potri) and takes each gradient in one elementwise pass: the textbook way, done well.
"""

from __future__ import annotations

import numpy as np
from problems import Problem
from scipy.linalg import blas, lapack

from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT

__all__ = ["naive"]


def naive(problem: Problem) -> tuple[float, np.ndarray]:
    """Return the log-likelihood and its gradient in the free coordinates."""
    parameters, kernel = problem.parameters, problem.kernel
    replicate, output, time = np.nonzero(problem.replicates.observed)
    y = problem.replicates.data[problem.replicates.observed]
    lags = np.subtract.outer(problem.replicates.times, problem.replicates.times)
    same = {PARENT: 1.0, CHILD: np.equal.outer(replicate, replicate)}

    covariance = np.diag(parameters.noise[output])
    for name, layer in parameters.layers.items():
        for b, scale in zip(layer.matrices, layer.lengthscales, strict=True):
            component = _at(kernel.value(lags, scale), time)
            component *= _at(b, output)
            component *= same[name]
            covariance += component
    value, adjoint = _log_density(covariance, y)

    one_hot = np.equal.outer(output, np.arange(len(parameters.noise))).astype(float)
    leaves = []
    for name, layer in parameters.layers.items():
        own = adjoint * same[name]
        by_b, by_scale = [], []
        for b, scale in zip(layer.matrices, layer.lengthscales, strict=True):
            by_b.append(_fold(own, _at(kernel.value(lags, scale), time), one_hot))
            slope = _fold(own, _at(kernel.gradient(lags, scale), time), one_hot)
            by_scale.append(np.sum(b * slope))
        pulled = layer.pull_back(np.array(by_scale), np.array(by_b))
        leaves += [leaf.ravel() for leaf in pulled.leaves]
    noise = np.bincount(output, np.diag(adjoint)) * parameters.noise
    return value, np.concatenate([*leaves, noise])


def _at(matrix: np.ndarray, index: np.ndarray) -> np.ndarray:
    return matrix.take(index, axis=0).take(index, axis=1)


def _fold(adjoint: np.ndarray, factor: np.ndarray, one_hot: np.ndarray) -> np.ndarray:
    """Sum the products of entries over all pairs of entries of two outputs; overwrite factor."""
    factor *= adjoint
    return one_hot.T @ (factor @ one_hot)


def _log_density(covariance: np.ndarray, y: np.ndarray) -> tuple[float, np.ndarray]:
    """Return log N(y; 0, K) and its derivative in the entries of K, whose memory it takes."""
    factor, _ = lapack.dpotrf(covariance.T, lower=1, clean=0, overwrite_a=1)
    alpha, _ = lapack.dpotrs(factor, y, lower=1)
    value = -0.5 * y @ alpha - np.log(np.diag(factor)).sum() - 0.5 * len(y) * np.log(2.0 * np.pi)
    inverse, _ = lapack.dpotri(factor, lower=1, overwrite_c=1)
    adjoint = np.tril(inverse, -1)
    adjoint += adjoint.T
    np.fill_diagonal(adjoint, np.diag(inverse))
    adjoint = blas.dger(-1.0, alpha, alpha, a=adjoint.T, overwrite_a=1)
    adjoint *= -0.5
    return float(value), adjoint
