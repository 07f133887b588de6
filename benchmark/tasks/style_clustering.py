"""Finding styles of locomotion in unlabelled recordings (HLM §4.1, Figures 1 and 2)."""

from __future__ import annotations

from mocapbench.baselines import Clusterer
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["StyleClustering", "style_clustering"]

MOST_STYLES = 8


def _cases() -> tuple[Case, ...]:
    numbers = range(1, MOST_STYLES + 1)
    real = [
        Case(f"C = {n}", {"styles": n}, CMU.sources, parameters={"n_styles": n}) for n in numbers
    ]
    synthetic = [
        Case(
            f"synthetic C = {n}",
            {"styles": n},
            SYNTHETIC.sources,
            synthetic=True,
            remark="Generated gait, not recordings of people.",
            parameters={"n_styles": n},
        )
        for n in numbers
    ]
    return (*real, *synthetic)


class StyleClustering(Task):
    """Figure 2: the purity of C clusters of 39 recordings in four styles."""

    name = "style-clustering"
    version = 1
    title = "Style clustering"
    reference = "HLM §4.1, Figures 1 and 2"
    description = (
        "Recordings of walks, slow walks, strides and runs, at 30 Hz and without labels, are to be "
        "grouped into C clusters, which are then compared with the labels. A fold is a restart: "
        "the recordings are the same, the model's random start is another."
    )
    kind = "cluster"
    requires = (Clusterer,)
    cases = _cases()
    entrants = (
        Entrant("cyclic-alignment", "cyclic-alignment", {"n_restarts": 1}),
        Entrant("k-cpm", "k-cpm", {"n_restarts": 1}),
    )
    metrics = ("purity", "adjusted_rand")
    profiles = {
        "smoke": Selection(("synthetic C = 2",), folds=1, budget={"max_iter": 3, "n_restarts": 1}),
        "quick": Selection(("C = 2", "C = 4", "C = 6", "C = 8", "synthetic C = 4"), folds=3),
        "paper": Selection(without_stand_ins(cases), folds=50),
    }
    illustrated = ("C = 4", "synthetic C = 4", *(case.name for case in cases))
    illustrated_channels = ("lfemur.rx", "ltibia.rx")
    remarks = (
        "Purity is the share of recordings that belong to the majority style of their cluster. It "
        "grows with C by itself; the adjusted Rand index does not.",
        "Intervals are over restarts on the same recordings: they say how much a start matters, "
        "not how other recordings would be clustered.",
    )

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ClusterProblem:
        """Give the recordings without their styles; every fold is the same problem."""
        del seeds  # a fold is a restart, which the entrant's own stream decides
        corpus = SYNTHETIC if case.synthetic else CMU
        return ClusterProblem(
            train=tuple(corpus.read(archive).values()),
            process=None,
            truth=tuple(corpus.styles.values()),
            skeleton=archive.read(corpus.sources[0]).skeleton,
        )


style_clustering = StyleClustering()
