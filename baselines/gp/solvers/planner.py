"""Which solver to use for each block: the one with the least estimated work."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.kronecker import Kronecker
from mocapbench.baselines.gp.solvers.latent_split.split_solver import LatentSplit
from mocapbench.baselines.gp.solvers.solver import Mapper, Solver
from mocapbench.baselines.gp.solvers.state_space.state_solver import StateSpace

__all__ = ["PLANS", "Plan", "describe_work", "solver_names", "with_mapper", "work"]

Plan = Callable[[StationaryKernel, Sequence[Block], Parameters], tuple[Solver, ...]]
"""Chooses a solver for each block; of the parameters only the shapes matter."""

_SOLVERS: tuple[type[Solver], ...] = (Dense, LatentSplit, StateSpace, Kronecker)


def work(
    kernel: StationaryKernel, blocks: Sequence[Block], parameters: Parameters
) -> tuple[Mapping[str, float], ...]:
    """Return for each block the estimated work of every solver; infinite if it cannot solve it."""
    solvers = [solver(kernel) for solver in _SOLVERS]
    return tuple(
        {solver.name: solver.work(block, parameters) for solver in solvers} for block in blocks
    )


def solver_names(solvers: Sequence[Solver]) -> str:
    """Return the names of the solvers in use, joined by plus signs."""
    return "+".join(sorted({solver.name for solver in solvers}))


def with_mapper(solvers: Sequence[Solver], mapper: Mapper) -> tuple[Solver, ...]:
    """Return the same solvers, which call functions of outputs through ``mapper``."""
    return tuple(type(solver)(solver.kernel, mapper) for solver in solvers)


def describe_work(
    solvers: Sequence[Solver], blocks: Sequence[Block], parameters: Parameters
) -> str:
    """Return the solvers in use, their work, and the work of each solver alone."""
    estimated = work(solvers[0].kernel, blocks, parameters)
    in_use = sum(of_block[solver.name] for of_block, solver in zip(estimated, solvers, strict=True))
    alone = {
        solver.name: sum(of_block[solver.name] for of_block in estimated) for solver in _SOLVERS
    }
    others = ", ".join(
        f"{name} alone {amount / 1e9:.2g}"
        for name, amount in sorted(alone.items(), key=lambda pair: pair[1])
        if np.isfinite(amount)
    )
    return (
        f"{solver_names(solvers)}: {in_use / 1e9:.2g} billion operations an evaluation ({others})"
    )


def _least_work(
    kernel: StationaryKernel, blocks: Sequence[Block], parameters: Parameters
) -> tuple[Solver, ...]:
    by_name = {solver.name: solver for solver in _SOLVERS}
    return tuple(
        by_name[min(of_block, key=of_block.__getitem__)](kernel)
        for of_block in work(kernel, blocks, parameters)
    )


def _always(solver: type[Solver]) -> Plan:
    def plan(
        kernel: StationaryKernel, blocks: Sequence[Block], parameters: Parameters
    ) -> tuple[Solver, ...]:
        for of_block in work(kernel, blocks, parameters):
            if np.isinf(of_block[solver.name]):
                able = sorted(name for name, amount in of_block.items() if np.isfinite(amount))
                raise ValueError(
                    f"expected a solver that can solve every part of this problem, got "
                    f"{solver.name!r}: it needs {solver.needs}; choose one of {able} here, or "
                    "'auto'"
                )
        return (solver(kernel),) * len(blocks)

    return plan


PLANS: Mapping[str, Plan] = MappingProxyType(
    {"auto": _least_work, **{solver.name: _always(solver) for solver in _SOLVERS}}
)
"""The plans by the name that models take: ``"auto"``, or a solver's own name."""
