"""Synthesis of new children on data from the toy process (thesis §5.2.1, Tables 12–13)."""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.pages.toy_synthesis import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.toy_interpolation import ONE_INCOMPLETE, Design
from mocapbench.datasets import Archive, ToyProcess
from mocapbench.datasets.process import uniform_weights

__all__ = ["toy_synthesis", "toy_synthesis_problem"]

N_POINTS = 30
N_SAMPLES = 25
N_REFERENCES = 25

_RBF = {"kernel": "rbf"}
_THREE = {"n_components": 3, **_RBF}


def toy_synthesis_problem(design: Design, seeds: Seeds, archive: Archive) -> SynthesiseProblem:
    """Draw a process, its children and the references; and, apart, an unrelated process."""
    del archive  # nothing is read
    rng = seeds.generator("data")
    process = _process(design, rng)
    times = np.linspace(0.0, 2.0 * np.pi, N_POINTS)
    parent, family = process.draw_family(rng, times, design.children + N_REFERENCES)
    return SynthesiseProblem(
        train=family[: design.children],
        times=times,
        n_samples=N_SAMPLES,
        references=tuple(child.values for child in family[design.children :]),
        control=_process(design, seeds.generator("control")),
        process=process,
        parent=parent,
    )


def _process(design: Design, rng: np.random.Generator) -> ToyProcess:
    return ToyProcess.random(
        rng, n_outputs=design.outputs, noise=design.noise, draw_weights=uniform_weights
    )


_NOT_QUICK = ("gpdm", "cyclic-alignment")
_CASES = tuple(
    Case(f"test {number}", partial(toy_synthesis_problem, design), design.columns)
    for number, design in enumerate(ONE_INCOMPLETE, start=1)
)

toy_synthesis: Task = Task(
    name="toy-synthesis",
    version=1,
    page=PAGE,
    requires={"draws samples"},
    meets={"true process", "unrelated process"},
    cases=_CASES,
    entrants=(
        Entrant("mohgp-3", "mohgp", _THREE),
        Entrant("moa-3", "moa", _THREE),
        Entrant("lmc-independent-3", "lmc-independent", _THREE),
        Entrant("gp-independent", "gp-independent", _RBF),
        Entrant("cyclic-alignment", "cyclic-alignment", {"n_styles": 1}),
        Entrant("oracle", "oracle"),
        Entrant("control", "control"),
    ),
    profiles={
        "smoke": Profile(
            ("test 1",), folds=2, budget={"max_iter": 5, "n_restarts": 1}, opt_in=("gpdm",)
        ),
        "quick": Profile(("test 1", "test 4", "test 9"), folds=3, opt_in=_NOT_QUICK),
        "paper": Profile(tuple(case.name for case in _CASES), folds=5, opt_in=("gpdm",)),
    },
)
"""New children, compared with children of the same parent that no model sees."""
