"""Recovery of the covariances that drew the data (thesis §5.2.3, Figures 11–13)."""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.recover import RecoverProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.pages.covariance_recovery import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, ToyProcess
from mocapbench.datasets.process import uniform_weights

__all__ = ["covariance_recovery", "recovery_problem"]

N_POINTS = 50


def recovery_problem(
    noise: float, outputs: int, children: int, seeds: Seeds, archive: Archive
) -> RecoverProblem:
    """Draw a process with correlated outputs, and its children."""
    del archive  # nothing is read
    rng = seeds.generator("data")
    process = ToyProcess.random(rng, n_outputs=outputs, noise=noise, draw_weights=uniform_weights)
    times = np.linspace(0.0, 2.0 * np.pi, N_POINTS)
    return RecoverProblem(train=process.draw(rng, times, children), process=process, times=times)


def _entrant(label: str, model: str, n_restarts: int) -> Entrant:
    parameters = {"n_components": 3, "kernel": "rbf", "n_restarts": n_restarts}
    return Entrant(label, model, parameters)


_CASE = Case(
    "correlated outputs",
    partial(recovery_problem, 0.001, 3, 5),
    {"noise": 0.001, "outputs": 3, "children": 5},
)

covariance_recovery: Task = Task(
    name="covariance-recovery",
    version=1,
    page=PAGE,
    requires={"has layers"},
    meets={"true process"},
    cases=(_CASE,),
    entrants=(
        _entrant("mohgp-3-starts-10", "mohgp", 10),
        _entrant("mohgp-3-starts-30", "mohgp", 30),
        _entrant("moa-3", "moa", 10),
        _entrant("lmc-independent-3", "lmc-independent", 10),
    ),
    profiles={
        "smoke": Profile((_CASE.name,), folds=1, budget={"max_iter": 25, "n_restarts": 1}),
        "quick": Profile((_CASE.name,), folds=1, budget={"max_iter": 200}),
        "paper": Profile((_CASE.name,), folds=5),
    },
)
"""Five complete children of one parent, three outputs that correlate."""
