"""Which solver to use: the one with the least counted work."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from mocapbench.baselines.gp.dense import Dense
from mocapbench.baselines.gp.kernels import Kernel
from mocapbench.baselines.gp.latent_split import LatentSplit
from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.reduction import Reduction
from mocapbench.baselines.gp.solver import Solver
from mocapbench.baselines.gp.state_space import StateSpace

__all__ = ["PLANS", "Plan"]

Plan = Callable[[Kernel, Reduction, Parameters], Solver]
"""Chooses the solver for a likelihood; the parameters matter by their shapes alone."""

_SOLVERS: tuple[type[Solver], ...] = (Dense, LatentSplit, StateSpace)


def _least_work(kernel: Kernel, reduction: Reduction, parameters: Parameters) -> Solver:
    def work(solver: Solver) -> float:
        return sum(solver.work(block, parameters) for block in reduction.blocks)

    return min((solver(kernel) for solver in _SOLVERS), key=work)


def _always(solver: type[Solver]) -> Plan:
    def plan(kernel: Kernel, reduction: Reduction, parameters: Parameters) -> Solver:  # noqa: ARG001
        return solver(kernel)

    return plan


PLANS: Mapping[str, Plan] = MappingProxyType(
    {"auto": _least_work, **{solver.name: _always(solver) for solver in _SOLVERS}}
)
"""The plans by the name that models take: ``"auto"``, or a solver's own name."""
