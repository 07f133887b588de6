"""The hierarchical model in GPy: `kern.Hierarchical` over two sums of coregionalised kernels."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import GPy
import numpy as np
from serve import serve

KERNELS = {"rbf": GPy.kern.RBF, "matern32": GPy.kern.Matern32}
JITTER = 1e-8
"""What GPy's exact inference adds to the noise variances."""
STEP = 1e-9
"""Relative change of the parameters: at unchanged ones a cached matrix is added to twice."""


def pose(problem: np.lib.npyio.NpzFile) -> Callable[[], tuple[float, np.ndarray]]:
    """Return what evaluates the model at the problem's point."""
    replicate, output, time = np.nonzero(problem["observed"])  # grouped by child, as it must be
    model = GPy.core.GP(
        X=np.column_stack([problem["times"][time], output, replicate]).astype(float),
        Y=problem["data"][problem["observed"]][:, None],
        kernel=_kernel(problem),
        likelihood=_noise(problem),
        Y_metadata={"output_index": output[:, None]},
    )
    exact = model.optimizer_array.copy()
    scales = itertools.cycle([1.0 + STEP, 1.0])

    def evaluate() -> tuple[float, np.ndarray]:
        model.optimizer_array = next(scales) * exact
        return float(model.log_likelihood()), _gradient(model)

    return evaluate


def _kernel(problem: np.lib.npyio.NpzFile) -> GPy.kern.Kern:
    return GPy.kern.Hierarchical([_layer(problem, name) for name in ("parent", "child")])


def _layer(problem: np.lib.npyio.NpzFile, name: str) -> GPy.kern.Kern:
    leaves = (problem[f"{name} {leaf}"] for leaf in ("lengthscales", "weights", "kappa"))
    parts = [_component(str(problem["kernel"]), *each) for each in zip(*leaves, strict=True)]
    return GPy.kern.Add(parts, name=name) if len(parts) > 1 else parts[0]


def _component(kernel: str, scale: float, weights: np.ndarray, kappa: np.ndarray) -> GPy.kern.Kern:
    over_time = KERNELS[kernel](1, lengthscale=scale, active_dims=[0])
    over_time.variance.fix(1.0)
    over_outputs = GPy.kern.Coregionalize(
        1, *weights.shape, W=weights, kappa=kappa, active_dims=[1]
    )
    return over_time * over_outputs


def _noise(problem: np.lib.npyio.NpzFile) -> GPy.likelihoods.MixedNoise:
    noises = problem["noise"] - JITTER
    return GPy.likelihoods.MixedNoise(
        [GPy.likelihoods.Gaussian(variance=b, name=f"noise{d}") for d, b in enumerate(noises)]
    )


def _gradient(model: GPy.core.GP) -> np.ndarray:
    leaves = []
    for layer in model.kern.parts:
        components = layer.parts if isinstance(layer, GPy.kern.Add) else [layer]
        times, outputs = zip(*(component.parts for component in components), strict=True)
        leaves += [k.lengthscale.gradient * k.lengthscale for k in times]
        leaves += [b.W.gradient for b in outputs]
        leaves += [2.0 * np.sqrt(b.kappa) * b.kappa.gradient for b in outputs]
    noises = [noise.variance for noise in model.likelihood.likelihoods_list]
    leaves += [noise.gradient * (noise + JITTER) for noise in noises]
    return np.concatenate([np.ravel(leaf) for leaf in leaves])


if __name__ == "__main__":
    serve(pose)
