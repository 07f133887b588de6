"""Recovery of the covariances that drew the data (thesis §5.2.3, Figures 11–13)."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import Layered
from mocapbench.benchmark.problems.recover import RecoverProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Selection, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive
from mocapbench.datasets.process import ToyProcess, uniform_weights

__all__ = ["CovarianceRecovery", "covariance_recovery"]

N_POINTS = 50


def _entrant(label: str, model: str, n_restarts: int) -> Entrant:
    parameters = {"n_components": 3, "kernel": "rbf", "n_restarts": n_restarts}
    return Entrant(label, model, parameters)


class CovarianceRecovery(Task):
    """Figures 11–13: five complete children of one parent, three outputs that correlate."""

    name = "covariance-recovery"
    version = 1
    title = "Recovery of the generating covariances"
    reference = "thesis §5.2.3, Figures 11–13"
    description = (
        "Five complete children of one parent are drawn from a process whose outputs correlate "
        "strongly: the factors of its coregionalisation matrices lie between 0 and 1. Fitted "
        "models show the covariance of the children around their parent, K_f, without noise, and "
        "the parent's, K_g, which are compared with the true ones. Every fold draws a new process."
    )
    kind = "recover"
    requires = (Layered,)
    has_process = True
    cases = (Case("correlated outputs", {"noise": 0.001, "outputs": 3, "children": 5}),)
    entrants = (
        _entrant("mohgp-3-starts-10", "mohgp", 10),
        _entrant("mohgp-3-starts-30", "mohgp", 30),
        _entrant("moa-3", "moa", 10),
        _entrant("lmc-independent-3", "lmc-independent", 10),
    )
    metrics = ("frobenius_child", "frobenius_parent", "logdet_child", "logdet_parent")
    profiles = {
        "smoke": Selection(
            ("correlated outputs",), folds=1, budget={"max_iter": 25, "n_restarts": 1}
        ),
        "quick": Selection(("correlated outputs",), folds=1, budget={"max_iter": 200}),
        "paper": Selection(("correlated outputs",), folds=5),
    }
    remarks = (
        "The thesis shows these covariances as pictures of one dataset and gives no numbers.",
        "A model with one kernel has no parent. Its kernel is set beside K_f, as in Figure 11 of "
        "the thesis; for the pooled model, whose one function all children share, and for "
        "independent draws, which carry the parent's variance too, K_g or K_f + K_g would be as "
        "fair a match.",
        "One parent was drawn, so that its covariance is known from a single draw: an estimate of "
        "K_g is poor however well a model is trained.",
    )
    illustrated = ("correlated outputs",)

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> RecoverProblem:
        """Draw a process with correlated outputs, and its children."""
        del archive  # nothing is read
        rng = seeds.generator("data")
        process = ToyProcess.random(
            rng,
            n_outputs=int(case.settings["outputs"]),
            noise=float(case.settings["noise"]),
            draw_weights=uniform_weights,
        )
        times = np.linspace(0.0, 2.0 * np.pi, N_POINTS)
        children = process.draw(rng, times, int(case.settings["children"]))
        return RecoverProblem(train=children, process=process, times=times)


covariance_recovery = CovarianceRecovery()
