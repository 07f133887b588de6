"""Interpolation on data from the toy process (thesis §5.1.1): three experiments.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_all_but
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.pages.toy_interpolation import (
    MUCH_NOISE_PAGE,
    ONE_INCOMPLETE_PAGE,
    TOO_FEW_COMPONENTS_PAGE,
)
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, ToyProcess

__all__ = [
    "ONE_INCOMPLETE",
    "Design",
    "toy_interpolation_1",
    "toy_interpolation_2",
    "toy_interpolation_3",
    "toy_problem",
]

N_POINTS = 50
RBF = {"kernel": "rbf"}
THREE: dict[str, int | str] = {"n_components": 3, **RBF}

SMOKE_BUDGET = {"max_iter": 5, "n_restarts": 1}


@dataclass(frozen=True, kw_only=True)
class Design:
    """How the data of a case are drawn.

    Parameters
    ----------
    noise : float
        Variance of the white noise.
    outputs, children : int
        D and R.
    incomplete : int
        How many children, the last ones, are incomplete.
    visible : int
        How many of 50 points of each output an incomplete child shows.
    components : int
        How many components each layer of the process has.
    """

    noise: float
    outputs: int = 3
    children: int = 10
    incomplete: int = 1
    visible: int = 5
    components: int = 3

    @property
    def columns(self) -> dict[str, str | int | float]:
        """What the first experiment's rows vary."""
        return {"noise": self.noise, "outputs": self.outputs, "children": self.children}


def toy_problem(design: Design, seeds: Seeds, archive: Archive) -> ImputeProblem:
    """Draw a process, a parent, its children and a mask of each incomplete child."""
    del archive  # nothing is read
    rng = seeds.generator("data")
    process = ToyProcess.random(
        rng, n_outputs=design.outputs, noise=design.noise, n_components=design.components
    )
    times = np.linspace(0.0, 2.0 * np.pi, N_POINTS)
    parent, children = process.draw_family(rng, times, design.children)
    first = design.children - design.incomplete
    masks, shape = seeds.generator("mask"), (N_POINTS, design.outputs)
    given = tuple(
        child.hide(hide_all_but(masks, design.visible, *shape)) for child in children[first:]
    )
    return ImputeProblem(
        train=(*children[:first], *given),
        given=given,
        truth=tuple(child.values for child in children[first:]),
        unit=Unit.natural(design.outputs),
        process=process,
        parent=parent,
    )


def _case(number: int, columns: dict[str, str | int | float], design: Design) -> Case:
    return Case(f"test {number}", partial(toy_problem, design), columns)


ONE_INCOMPLETE = tuple(
    Design(noise=noise, outputs=outputs, children=children)
    for noise in (0.001, 0.01, 0.1)
    for outputs, children in ((3, 5), (6, 6), (3, 10))
)
"""The nine tests of the first experiment."""


def _one_incomplete() -> tuple[Case, ...]:
    return tuple(
        _case(number, design.columns, design) for number, design in enumerate(ONE_INCOMPLETE, 1)
    )


_MISSING_IN = {"all": Design(noise=0.1).children, "one": 1}


def _too_few_components() -> tuple[Case, ...]:
    rows = [(noise, missing) for missing in _MISSING_IN for noise in (0.001, 0.01, 0.1)]
    return tuple(
        _case(
            number,
            {"noise": noise, "missing in": missing},
            Design(noise=noise, incomplete=_MISSING_IN[missing]),
        )
        for number, (noise, missing) in enumerate(rows, start=1)
    )


def _much_noise() -> tuple[Case, ...]:
    rows = [(visible, missing) for visible in (10, 20) for missing in _MISSING_IN]
    return tuple(
        _case(
            number,
            {"visible": visible, "missing in": missing},
            Design(noise=0.1, incomplete=_MISSING_IN[missing], visible=visible, components=1),
        )
        for number, (visible, missing) in enumerate(rows, start=1)
    )


# What the thesis lacks: models without a hierarchy, or without outputs that covary.
_OTHERS = (
    Entrant("lmc-independent-3", "lmc-independent", THREE),
    Entrant("hgp", "hgp", RBF),
    Entrant("gp-independent", "gp-independent", RBF),
)
_MOHGP_1 = Entrant("mohgp-1", "mohgp", {"n_components": 1, **RBF})


_NOT_CYCLIC = ("cyclic-alignment",)
"""Takes longer on curves without a cycle than the others, and the quick profile has walks."""
_SLOW = (*_NOT_CYCLIC, "best-of")
"""`best-of` takes as long, and is tried in the other tasks of this kind."""


def _paper(cases: tuple[Case, ...]) -> Profile:
    return Profile(tuple(case.name for case in cases), folds=5)


toy_interpolation_1: Task = Task(
    name="toy-interpolation-1",
    version=1,
    page=ONE_INCOMPLETE_PAGE,
    requires={"fills entries"},
    meets={"true process"},
    cases=_one_incomplete(),
    entrants=(Entrant("mohgp-3", "mohgp", THREE), Entrant("moa-3", "moa", THREE), *_OTHERS),
    profiles={
        "smoke": Profile(("test 1",), folds=2, budget=SMOKE_BUDGET),
        "quick": Profile(("test 1", "test 4", "test 9"), folds=2, opt_in=_NOT_CYCLIC),
        "paper": _paper(_one_incomplete()),
    },
)
"""Tables 1–3: the last child has 5 of 50 points visible, the others are complete."""

toy_interpolation_2: Task = Task(
    name="toy-interpolation-2",
    version=1,
    page=TOO_FEW_COMPONENTS_PAGE,
    requires={"fills entries"},
    meets={"true process"},
    cases=_too_few_components(),
    entrants=(_MOHGP_1, Entrant("moa-3", "moa", {"n_restarts": 5, **THREE}), *_OTHERS),
    profiles={
        "smoke": Profile(("test 4",), folds=1, budget=SMOKE_BUDGET, opt_in=_SLOW),
        "quick": Profile(("test 1", "test 4"), folds=2, budget={"n_restarts": 1}, opt_in=_SLOW),
        "paper": _paper(_too_few_components()),
    },
)
"""Tables 4–6: one component a layer in the hierarchical model, a tuned LMC in the reference."""

toy_interpolation_3: Task = Task(
    name="toy-interpolation-3",
    version=1,
    page=MUCH_NOISE_PAGE,
    requires={"fills entries"},
    meets={"true process"},
    cases=_much_noise(),
    entrants=(_MOHGP_1, Entrant("moa-3", "moa", {"n_restarts": 10, **THREE}), *_OTHERS),
    profiles={
        "smoke": Profile(("test 2",), folds=1, budget=SMOKE_BUDGET, opt_in=_SLOW),
        "quick": Profile(("test 2",), folds=2, budget={"n_restarts": 1}, opt_in=_NOT_CYCLIC),
        "paper": _paper(_much_noise()),
    },
)
"""Tables 7–9: data of one component a layer; more points are visible, under much noise."""
