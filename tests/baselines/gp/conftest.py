"""A brute-force oracle: the joint Gaussian of every visible entry of every replicate."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import strategies as st

from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.gp.prior.kernels import KERNELS, StationaryKernel
from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT, LayerParameters, Parameters
from mocapbench.baselines.gp.process import FittedProcess
from mocapbench.baselines.gp.reduction.hierarchy import reduce_hierarchy
from mocapbench.baselines.gp.reduction.reduction import (
    Reduction,
    Replicates,
    pool_replicates,
    separate_replicates,
)
from mocapbench.baselines.gp.reduction.tree import Path, Tree, grow
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.solver import Solver


@dataclass(frozen=True)
class Structure:
    """A reduction, the layers that its model has, and the length of its replicates' paths."""

    reduce: Callable[[Replicates, Tree], Reduction]
    layers: tuple[str, ...]
    depth: int = 0


STRUCTURES = {
    "hierarchical": Structure(reduce_hierarchy, (PARENT, CHILD)),
    "pooled": Structure(lambda replicates, tree: pool_replicates(replicates), (PARENT,)),
    "independent": Structure(lambda replicates, tree: separate_replicates(replicates), (CHILD,)),
    "grouped": Structure(reduce_hierarchy, (PARENT, "group-1", CHILD), 1),
    "nested": Structure(reduce_hierarchy, (PARENT, "group-1", "group-2", CHILD), 2),
}


@dataclass(frozen=True)
class ModelCase:
    """Everything that a likelihood depends on."""

    structure: Structure
    replicates: Replicates
    parameters: Parameters
    kernel: StationaryKernel
    paths: tuple[Path, ...] | None

    @property
    def tree(self) -> Tree:
        names = [str(r) for r in range(len(self.replicates.data))]
        grown = grow(names, self.paths and dict(zip(names, self.paths, strict=True)))
        return {name: grown[name] for name in self.structure.layers}

    @property
    def reduction(self) -> Reduction:
        return self.structure.reduce(self.replicates, self.tree)

    def process(self, solvers: tuple[Solver, ...]) -> FittedProcess:
        """Return the process of the case, whose outputs are in standard units."""
        _, n_outputs, _ = self.replicates.data.shape
        units = Standardisation(np.zeros(n_outputs), np.ones(n_outputs), np.zeros(n_outputs))
        return FittedProcess(self.kernel, self.reduction, solvers, self.parameters, units)


class BruteForce:
    """The dense joint Gaussian, from the definition of the model, without the code under test."""

    def __init__(self, case: ModelCase) -> None:
        self.case = case
        self.rows = np.argwhere(case.replicates.observed)
        self.data = case.replicates.data[case.replicates.observed]

    def log_likelihood(self, parameters: Parameters) -> float:
        covariance = self.covariance(parameters)
        sign, log_determinant = np.linalg.slogdet(2.0 * np.pi * covariance)
        assert sign > 0
        return -0.5 * float(log_determinant + self.data @ np.linalg.solve(covariance, self.data))

    def gradient(self, parameters: Parameters) -> np.ndarray:
        flat, step = parameters.flat, 1e-5
        ascent = [
            (
                self.log_likelihood(parameters.at(flat + step * unit))
                - self.log_likelihood(parameters.at(flat - step * unit))
            )
            / (2.0 * step)
            for unit in np.eye(len(flat))
        ]
        return np.array(ascent)

    def posterior(
        self, times: np.ndarray, replicate: int | None, layers: tuple[str, ...]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return mean and variance (D, M) of the sum of ``layers``; None is a new replicate."""
        parameters = self.case.parameters
        n_outputs = len(parameters.log_noise)
        index = -1 if replicate is None else replicate
        targets = [(index, d, t) for d in range(n_outputs) for t in times]
        points = self._points()
        cross = self._signal(parameters, targets, points, layers)
        prior = self._signal(parameters, targets, targets, layers)
        solved = np.linalg.solve(self.covariance(parameters), cross.T)
        variance = np.diagonal(prior) - np.einsum("ij,ji->i", cross, solved)
        shape = (n_outputs, len(times))
        return (self.data @ solved).reshape(shape), variance.reshape(shape)

    def covariance(self, parameters: Parameters) -> np.ndarray:
        points = self._points()
        signal = self._signal(parameters, points, points, tuple(parameters.layers))
        return signal + np.diag(parameters.noise[self.rows[:, 1]])

    def _draws(self, name: str) -> np.ndarray:
        """Return the index of each replicate's draw of a layer, and last a new replicate's."""
        nodes = self.case.tree[name]
        known = list(dict.fromkeys(nodes))
        return np.array([*(known.index(node) for node in nodes), 0 if name == PARENT else -1])

    def _points(self) -> list[tuple[int, int, float]]:
        times = self.case.replicates.times
        return [(int(r), int(d), float(times[t])) for r, d, t in self.rows]

    def _signal(self, parameters, left, right, layers) -> np.ndarray:
        (r1, d1, t1), (r2, d2, t2) = (
            map(np.array, zip(*side, strict=True)) for side in (left, right)
        )
        total = np.zeros((len(left), len(right)))
        for name in layers:
            layer = parameters.layers[name]
            draws = self._draws(name)
            shared = np.equal.outer(draws[r1], draws[r2])
            for b, scale in zip(layer.matrices, layer.lengthscales, strict=True):
                kernel = self.case.kernel.value(np.subtract.outer(t1, t2), scale)
                total += shared * b[np.ix_(d1, d2)] * kernel
        return total


def draw_case(
    rng: np.random.Generator,
    *,
    structure: str = "hierarchical",
    kernel: str = "matern32",
    n_outputs: int = 2,
    n_replicates: int = 3,
    n_times: int = 6,
    n_components: int = 1,
    rank: int = 1,
    masks: str = "mixed",
) -> ModelCase:
    """Draw data, masks and parameters."""
    shape = (n_replicates, n_outputs, n_times)
    observed = MASKS[masks](rng, shape)
    if not observed.any():
        observed[0, 0, 0] = True
    data = np.where(observed, rng.standard_normal(shape), 0.0)
    times = np.sort(rng.uniform(0.0, 3.0, n_times)) + 0.05 * np.arange(n_times)
    layers = {
        name: LayerParameters(
            rng.uniform(-1.0, 0.5, n_components),
            rng.standard_normal((n_components, n_outputs, rank)),
            rng.uniform(-1.0, 1.0, (n_components, n_outputs)),
        )
        for name in STRUCTURES[structure].layers
    }
    parameters = Parameters(layers, rng.uniform(-3.0, 0.0, n_outputs))
    replicates = Replicates(times, data, observed)
    paths = _paths(rng, n_replicates, STRUCTURES[structure].depth)
    return ModelCase(STRUCTURES[structure], replicates, parameters, KERNELS[kernel], paths)


def _paths(rng: np.random.Generator, n_replicates: int, depth: int) -> tuple[Path, ...] | None:
    """Return paths of a depth, with up to two branches at a node, or None for two layers."""
    labels = rng.integers(2, size=(n_replicates, depth)).astype(str)
    return tuple(tuple(path) for path in labels) if depth else None


def _mixed(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """About half of the replicates complete, some empty, the others with different masks."""
    observed = rng.random(shape) < 0.6
    observed[rng.random(shape[0]) < 0.5] = True
    observed[rng.random(shape[0]) < 0.15] = False
    return observed


MASKS: Mapping[str, Callable[..., np.ndarray]] = {
    "complete": lambda _, shape: np.ones(shape, dtype=bool),
    "frames": lambda rng, shape: np.broadcast_to(
        rng.random((shape[0], 1, shape[2])) < 0.6, shape
    ).copy(),
    "mixed": _mixed,
    "shared": lambda rng, shape: np.broadcast_to(rng.random(shape[1:]) < 0.6, shape).copy(),
}


@st.composite
def _cases(draw: st.DrawFn) -> ModelCase:
    return draw_case(
        np.random.default_rng(draw(st.integers(0, 2**32 - 1))),
        structure=draw(st.sampled_from(sorted(STRUCTURES))),
        kernel=draw(st.sampled_from(sorted(KERNELS))),
        n_outputs=draw(st.integers(1, 3)),
        n_replicates=draw(st.integers(1, 5)),
        n_times=draw(st.integers(1, 6)),
        n_components=draw(st.integers(1, 2)),
        rank=draw(st.integers(0, 2)),
        masks=draw(st.sampled_from(sorted(MASKS))),
    )


@pytest.fixture(scope="session")
def cases() -> st.SearchStrategy[ModelCase]:
    """A strategy over cases of every structure, kernel, size and mask."""
    return _cases()


@pytest.fixture(scope="session")
def case() -> Callable[..., ModelCase]:
    """The function that draws one case."""
    return draw_case


def _by(solver: type[Solver], case: ModelCase) -> tuple[Solver, ...]:
    able = [
        np.isfinite(solver(case.kernel).work(block, case.parameters))
        for block in case.reduction.blocks
    ]
    return tuple((solver if serves else Dense)(case.kernel) for serves in able)


@pytest.fixture(scope="session")
def by() -> Callable[[type[Solver], ModelCase], tuple[Solver, ...]]:
    """From solver and case to a solver for each block: the given one, or dense if it cannot."""
    return _by


def _served(solver: type[Solver]) -> st.SearchStrategy[ModelCase]:
    def possible(case: ModelCase) -> bool:
        return any(
            np.isfinite(solver(case.kernel).work(block, case.parameters))
            for block in case.reduction.blocks
        )

    return _cases().filter(possible)


@pytest.fixture(scope="session")
def served() -> Callable[[type[Solver]], st.SearchStrategy[ModelCase]]:
    """From a solver to the cases of which it can solve at least one block."""
    return _served


@pytest.fixture(scope="session")
def with_outputs() -> Callable[[Parameters, np.ndarray], Parameters]:
    """Return the function that picks outputs from parameters, in any order."""
    return _with_outputs


def _with_outputs(parameters: Parameters, index: np.ndarray) -> Parameters:
    layers = {
        name: LayerParameters(
            layer.log_lengthscales,
            layer.weights[:, index],
            layer.kappa_roots[:, index],
        )
        for name, layer in parameters.layers.items()
    }
    return Parameters(layers, parameters.log_noise[index])


@pytest.fixture(scope="session")
def brute_force() -> Callable[[ModelCase], BruteForce]:
    """The oracle of a case."""
    return BruteForce
