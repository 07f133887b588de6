"""Finding styles of locomotion in unlabelled recordings (HLM §4.1, Figures 1 and 2).

W. Pan and L. Torresani, *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML 2009.
"""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC, Styles, read_features
from mocapbench.benchmark.tasks.pages.style_clustering import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["clustering_problem", "style_clustering"]

MOST_STYLES = 8


def clustering_problem(styles: Styles, seeds: Seeds, archive: Archive) -> ClusterProblem:
    """Give the recordings without their styles; every fold is the same problem."""
    del seeds  # a fold is a restart, which the entrant's own stream decides
    return ClusterProblem(
        train=tuple(read_features(styles, archive).values()),
        truth=tuple(styles.values()),
        skeleton=archive.skeleton(next(iter(styles))),
    )


def _cases(styles: Styles, prefix: str, *, synthetic: bool) -> tuple[Case, ...]:
    return tuple(
        Case(
            f"{prefix}C = {n}",
            partial(clustering_problem, styles),
            {"styles": n},
            tuple(styles),
            synthetic=synthetic,
            parameters={"n_styles": n},
        )
        for n in range(1, MOST_STYLES + 1)
    )


_CASES = (
    *_cases(CMU, "", synthetic=False),
    *_cases(SYNTHETIC, "synthetic ", synthetic=True),
)

style_clustering: Task = Task(
    name="style-clustering",
    version=1,
    page=PAGE,
    requires={"clusters"},
    cases=_CASES,
    entrants=(
        Entrant("cyclic-alignment", "cyclic-alignment", {"n_restarts": 1, "grouping": "similar"}),
        Entrant("k-cpm", "k-cpm", {"n_restarts": 1}),
        Entrant("k-fam", "k-fam", {"n_restarts": 1}),
        Entrant("lgssm", "lgssm", {"n_restarts": 1}),
    ),
    profiles={
        "smoke": Profile(("synthetic C = 2",), folds=1, budget={"max_iter": 3, "n_restarts": 1}),
        "quick": Profile(("C = 2", "C = 4", "C = 8", "synthetic C = 4"), folds=3),
        "paper": Profile(on_recordings(_CASES), folds=50),
    },
)
"""Figure 2: the purity of C clusters of 39 recordings in four styles."""
