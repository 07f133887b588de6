import numpy as np
import pytest

from mocapbench.benchmark import METRICS, TASKS, Clusters
from mocapbench.benchmark.tasks.hlm_recordings import SYNTHETIC

TASK = TASKS.get("style-clustering")


def test_recordings_are_clustered_without_their_styles(posed):
    problem = posed(TASK.name, "synthetic C = 3")
    assert [recording.name for recording in problem.train] == list(SYNTHETIC)
    outcome = problem.outcome(Clusters(np.zeros(len(problem.train), dtype=int)))
    assert METRICS.get("purity")(outcome).value == pytest.approx(12 / 21)


@pytest.mark.parametrize("case", TASK.cases, ids=lambda case: case.name)
def test_a_case_asks_for_as_many_clusters_as_it_says(case):
    assert case.parameters == {"n_styles": case.columns["styles"]}
