"""Interpolation on data from the toy process (thesis §5.1.1): what the three experiments share."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines import Imputer
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.masks import hide_all_but
from mocapbench.benchmark.tasks.base import Case, Entrant, Setting, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive
from mocapbench.datasets.process import ToyProcess

__all__ = ["RBF", "Design", "ToyInterpolation", "baselines"]

N_POINTS = 50
RBF = {"kernel": "rbf"}


def baselines(n_components: int) -> tuple[Entrant, ...]:
    """Return the entrants that the thesis lacks: without a hierarchy, or outputs that covary."""
    return (
        Entrant(
            f"lmc-independent-{n_components}",
            "lmc-independent",
            {"n_components": n_components, **RBF},
        ),
        Entrant("hgp", "hgp", RBF),
        Entrant("gp-independent", "gp-independent", RBF),
    )


@dataclass(frozen=True, kw_only=True)
class Design:
    """How the data of a case are drawn.

    Parameters
    ----------
    noise : float
        Variance of the white noise.
    outputs, children : int
        D and R.
    visible : int
        How many of 50 points of each output an incomplete child shows.
    missing : {"one", "all"}
        Which children are incomplete: the last one, or every one.
    components : int
        How many components each layer of the process has.
    """

    noise: float
    outputs: int = 3
    children: int = 10
    visible: int = 5
    missing: Setting = "one"
    components: int = 3

    @property
    def incomplete(self) -> int:
        """How many children, the last ones, are incomplete."""
        return {"one": 1, "all": self.children}[str(self.missing)]


class ToyInterpolation(Task):
    """Fill the hidden entries of children of one parent."""

    requires = (Imputer,)
    has_process = True
    metrics = ("smse_pooled", "mse", "msll", "smse")
    published_metrics = {"mse": "MSE", "smse_pooled": "SMSE", "msll": "MSLL"}
    remarks: tuple[str, ...] = (
        "The thesis used one dataset per test and does not disclose the variances of its layers; "
        "here every fold draws a new dataset, so ± speaks of the protocol and not of one draw.",
        "The thesis's SMSE is pooled: its ratios MSE/SMSE show one variance over all hidden "
        "entries.",
    )
    illustrated_channels = ("output-1",)

    @abstractmethod
    def design(self, case: Case) -> Design:
        """Return how the data of ``case`` are drawn."""

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ImputeProblem:
        """Draw a process, a parent, its children and a mask of each incomplete child."""
        del archive  # nothing is read
        design, rng = self.design(case), seeds.generator("data")
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
            process=process,
            given=given,
            truth=tuple(child.values for child in children[first:]),
            unit=Unit.natural(design.outputs),
            parent=parent,
        )
