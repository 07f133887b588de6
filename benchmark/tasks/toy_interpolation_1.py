"""Experiment one on toy data: one child is incomplete (thesis §5.1.1, Tables 1–3)."""

from __future__ import annotations

from mocapbench.benchmark.tasks.base import Case, Entrant, Selection
from mocapbench.benchmark.tasks.toy_interpolation import RBF, Design, ToyInterpolation, baselines

__all__ = ["ToyInterpolation1", "toy_interpolation_1"]


def _cases() -> tuple[Case, ...]:
    rows = [(noise, d, r) for noise in (0.001, 0.01, 0.1) for d, r in ((3, 5), (6, 6), (3, 10))]
    return tuple(
        Case(
            name=f"test {number}",
            settings={"noise": noise, "outputs": d, "children": r},
            published=f"test {number}",
        )
        for number, (noise, d, r) in enumerate(rows, start=1)
    )


class ToyInterpolation1(ToyInterpolation):
    """Tables 1–3: the last child has 5 of 50 points visible, the others are complete."""

    name = "toy-interpolation-1"
    version = 1
    title = "Toy interpolation, one incomplete child"
    reference = "thesis §5.1.1, Tables 1–3, Figure 17"
    description = (
        "Children of one parent are drawn from a two-layer LMC Gaussian process with three "
        "components a layer. All are complete but the last, of which 5 of 50 points per output "
        "are visible; the rest is to be filled. Every fold draws a new process, new children and "
        "a new mask."
    )
    cases = _cases()
    entrants = (
        Entrant("mohgp-3", "mohgp", {"n_components": 3, **RBF}),
        Entrant("moa-3", "moa", {"n_components": 3, **RBF}),
        *baselines(3),
    )
    profiles = {
        "smoke": Selection(("test 1",), folds=2, budget={"max_iter": 25, "n_restarts": 1}),
        "quick": Selection(("test 1", "test 4", "test 9"), folds=3),
        "paper": Selection(tuple(case.name for case in cases), folds=5),
    }
    published_models = {"mohgp-3": "MOHGP", "moa-3": "MOA"}
    illustrated = ("test 1",)

    def design(self, case: Case) -> Design:
        """Return what the row varies: noise, outputs and children."""
        return Design(
            noise=float(case.settings["noise"]),
            outputs=int(case.settings["outputs"]),
            children=int(case.settings["children"]),
        )


toy_interpolation_1 = ToyInterpolation1()
