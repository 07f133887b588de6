"""Experiment three on toy data: one component a layer, much noise (Tables 7–9)."""

from __future__ import annotations

from mocapbench.benchmark.tasks.base import Case, Entrant, Selection
from mocapbench.benchmark.tasks.toy_interpolation import RBF, Design, ToyInterpolation, baselines

__all__ = ["ToyInterpolation3", "toy_interpolation_3"]

_BELOW_THE_NOISE = (
    "Table 7 has mean squared errors of .078 and .095 where the noise alone has a variance of .1, "
    "so Tables 7–9 were not scored against noisy observations, as ours are"
)


def _cases() -> tuple[Case, ...]:
    rows = [(visible, missing) for visible in (10, 20) for missing in ("all", "one")]
    return tuple(
        Case(
            name=f"test {number}",
            settings={"visible": visible, "missing in": missing},
            published=f"test {number}",
        )
        for number, (visible, missing) in enumerate(rows, start=1)
    )


class ToyInterpolation3(ToyInterpolation):
    """Tables 7–9: an ICM drew the data; more points are visible, under much noise."""

    name = "toy-interpolation-3"
    version = 1
    title = "Toy interpolation under much noise"
    reference = "thesis §5.1.1, Tables 7–9, Figure 19"
    description = (
        "Data from one component a layer with noise of variance .1, three outputs and ten "
        "children, of which all or only the last are incomplete: 10 or 20 of 50 points per output "
        "are visible. The hierarchical model has one component a layer, as the process has; the "
        "reference model has three and is trained from ten starts."
    )
    cases = _cases()
    entrants = (
        Entrant("mohgp-1", "mohgp", {"n_components": 1, **RBF}),
        Entrant("moa-3", "moa", {"n_components": 3, "n_restarts": 10, **RBF}),
        *baselines(3),
    )
    profiles = {
        "smoke": Selection(("test 2",), folds=1, budget={"max_iter": 25, "n_restarts": 1}),
        "quick": Selection(("test 2",), folds=2, budget={"n_restarts": 1}),
        "paper": Selection(tuple(case.name for case in cases), folds=5),
    }
    published_models = {"mohgp-1": "MOHGP", "moa-3": "MOA"}
    not_comparable = dict.fromkeys([("mohgp-1", "*"), ("moa-3", "*")], _BELOW_THE_NOISE)
    remarks = (
        *ToyInterpolation.remarks,
        "The thesis does not say how many outputs and children these tests had; three and ten are "
        "assumed.",
    )
    illustrated = ("test 2",)

    def design(self, case: Case) -> Design:
        """Return what the row varies: visible points, and which children are incomplete."""
        return Design(
            noise=0.1,
            visible=int(case.settings["visible"]),
            missing=case.settings["missing in"],
            components=1,
        )


toy_interpolation_3 = ToyInterpolation3()
