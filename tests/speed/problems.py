"""Problems of the sizes that matter: data drawn from the model, and the point to evaluate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.prior.kernels import KERNELS, StationaryKernel
from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT, LayerParameters, Parameters
from mocapbench.baselines.gp.reduction.hierarchy import reduce_hierarchy
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates, separate_replicates

__all__ = ["SIZES", "Problem", "Size", "pose"]

NOISE = 0.05
STRUCTURES = {
    "hierarchical": ((PARENT, CHILD), reduce_hierarchy),
    "independent": ((CHILD,), separate_replicates),
}


@dataclass(frozen=True, kw_only=True)
class Size:
    """D outputs, N times, R replicates, Q components of a rank; the last replicates are masked."""

    n_outputs: int
    n_times: int
    n_replicates: int
    n_components: int = 1
    rank: int = 1
    kernel: str = "matern32"
    n_masked: int = 1
    n_visible: int
    structure: str = "hierarchical"


def _toy(**how: int) -> Size:
    return Size(n_times=50, n_components=3, kernel="rbf", n_visible=5, **how)


def _mocap(**how: int) -> Size:
    return Size(n_outputs=39, n_times=90, n_visible=25, **how)


def _database(**how: int) -> Size:
    return Size(n_outputs=62, n_replicates=39, **how)


SIZES = {
    "toy D3 R5": _toy(n_outputs=3, n_replicates=5),
    "toy D6 R10, one child": _toy(n_outputs=6, n_replicates=10),
    "toy D6 R10, all children": _toy(n_outputs=6, n_replicates=10, n_masked=10),
    "mocap Q1": _mocap(n_replicates=3),
    "mocap Q3": _mocap(n_replicates=3, n_components=3),
    "mocap Q1 R39": _mocap(n_replicates=39),
    "D62 N300 R39, complete": _database(n_times=300, n_visible=300, n_masked=0),
    "D62 N300 R39, one child": _database(n_times=300, n_visible=90),
    "D62 N1000 R39, complete": _database(n_times=1000, n_visible=1000, n_masked=0),
    "D62 N1000 R39, one child": _database(n_times=1000, n_visible=300),
    "multitask D39 N90": Size(
        n_outputs=39,
        n_times=90,
        n_replicates=1,
        n_masked=0,
        n_visible=90,
        structure="independent",
    ),
}


@dataclass(frozen=True, eq=False)
class Problem:
    """Data and the point at which the likelihood is evaluated."""

    replicates: Replicates
    parameters: Parameters
    kernel_name: str
    reduction: Reduction

    @property
    def kernel(self) -> StationaryKernel:
        return KERNELS[self.kernel_name]


def pose(size: Size) -> Problem:
    """Draw parameters, data and masks."""
    rng = np.random.default_rng(0)
    kernel = KERNELS[size.kernel]
    layers, reduce = STRUCTURES[size.structure]
    times = np.linspace(0.0, 2.0 * np.pi, size.n_times)
    parameters = Parameters(
        {name: _layer(size, rng) for name in layers}, np.full(size.n_outputs, np.log(NOISE))
    )
    n_draws = {PARENT: 1, CHILD: size.n_replicates}
    curves = sum(
        layer.draw(kernel, times, n_draws[name], rng) for name, layer in parameters.layers.items()
    )
    observed = _observed(size, rng)
    noisy = curves.transpose(0, 2, 1) + np.sqrt(NOISE) * rng.standard_normal(observed.shape)
    replicates = Replicates(times, np.where(observed, noisy, 0.0), observed)
    return Problem(replicates, parameters, size.kernel, reduce(replicates))


def _layer(size: Size, rng: np.random.Generator) -> LayerParameters:
    shape = (size.n_components, size.n_outputs)
    return LayerParameters(
        rng.uniform(-1.0, 0.0, size.n_components),
        rng.standard_normal((*shape, size.rank)),
        rng.uniform(0.2, 0.5, shape),
    )


def _observed(size: Size, rng: np.random.Generator) -> np.ndarray:
    observed = np.ones((size.n_replicates, size.n_outputs, size.n_times), dtype=bool)
    masked = observed[size.n_replicates - size.n_masked :]
    order = rng.permuted(np.broadcast_to(np.arange(size.n_times), masked.shape), axis=2)
    masked[:] = order < size.n_visible
    return observed
