"""Experiment two on toy data: the hierarchical model has too few components (Tables 4–6)."""

from __future__ import annotations

from mocapbench.benchmark.tasks.base import Case, Entrant, Selection
from mocapbench.benchmark.tasks.toy_interpolation import RBF, Design, ToyInterpolation, baselines

__all__ = ["ToyInterpolation2", "toy_interpolation_2"]


def _cases() -> tuple[Case, ...]:
    rows = [(noise, missing) for missing in ("all", "one") for noise in (0.001, 0.01, 0.1)]
    return tuple(
        Case(
            name=f"test {number}",
            settings={"noise": noise, "missing in": missing},
            published=f"test {number}",
        )
        for number, (noise, missing) in enumerate(rows, start=1)
    )


class ToyInterpolation2(ToyInterpolation):
    """Tables 4–6: an ICM in each layer of the hierarchical model, a tuned LMC in the reference."""

    name = "toy-interpolation-2"
    version = 1
    title = "Toy interpolation, one component against three"
    reference = "thesis §5.1.1, Tables 4–6, Figure 18"
    description = (
        "Data as in the first experiment, three outputs and ten children, of which all or only "
        "the last are incomplete: 5 of 50 points per output are visible. The hierarchical model "
        "has one component a layer where the process has three; the reference model has three and "
        "is trained from five starts."
    )
    cases = _cases()
    entrants = (
        Entrant("mohgp-1", "mohgp", {"n_components": 1, **RBF}),
        Entrant("moa-3", "moa", {"n_components": 3, "n_restarts": 5, **RBF}),
        *baselines(3),
    )
    profiles = {
        "smoke": Selection(("test 4",), folds=1, budget={"max_iter": 25, "n_restarts": 1}),
        "quick": Selection(("test 1", "test 4"), folds=2, budget={"n_restarts": 1}),
        "paper": Selection(tuple(case.name for case in cases), folds=5),
    }
    published_models = {"mohgp-1": "MOHGP", "moa-3": "MOA"}
    remarks = (
        *ToyInterpolation.remarks,
        "The thesis does not say how many outputs and children these tests had; three and ten are "
        "assumed.",
    )
    illustrated = ("test 4",)

    def design(self, case: Case) -> Design:
        """Return what the row varies: noise, and which children are incomplete."""
        return Design(noise=float(case.settings["noise"]), missing=case.settings["missing in"])


toy_interpolation_2 = ToyInterpolation2()
