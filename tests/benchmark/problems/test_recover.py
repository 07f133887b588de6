import numpy as np
import pytest

from mocapbench.baselines import Layered
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import open_archive

TASK = TASKS.get("covariance-recovery")
METRIC_NAMES = ("frobenius_child", "frobenius_parent", "logdet_child", "logdet_parent")


@pytest.fixture(scope="module")
def problem():
    case = TASK.cases[0]
    return TASK.problem(case, Seeds(0, TASK.name, TASK.version, case.name, 0), open_archive())


class _Told(Layered):
    """Shows covariances that it was told."""

    layers = ("parent", "child")

    def __init__(self, covariances=None):
        self.covariances = covariances

    def fit(self, recordings):
        return self

    def covariance(self, layer, times):
        return self.covariances[layer]


class _Flat(_Told):
    layers = ("only",)


def _scores(outcome):
    metrics = [METRICS.get(name) for name in METRIC_NAMES]
    return {metric.name: metric(outcome).value for metric in metrics if metric.applies(outcome)}


def test_the_data_are_as_the_paper_says(problem):
    assert len(problem.train) == 5
    assert all(child.values.shape == (50, 3) and child.visible.all() for child in problem.train)
    assert problem.process.noise == 0.001
    assert (problem.process.parent.coregionalisation > 0).all()


def test_the_truth_has_no_error(problem):
    solution = problem.solve(_Told(problem.truth), 0)
    scores = _scores(problem.outcome(solution))
    assert set(scores) == set(METRIC_NAMES)
    assert max(map(abs, scores.values())) < 1e-9


def test_the_one_kernel_of_a_model_without_a_hierarchy_stands_for_the_childrens(problem):
    solution = problem.solve(_Flat({"only": problem.truth["child"]}), 0)
    assert set(solution) == {"covariance-child"}
    assert set(_scores(problem.outcome(solution))) == {"frobenius_child", "logdet_child"}


@pytest.mark.parametrize("wrong", [np.eye(3), np.full((150, 150), np.nan)])
def test_a_covariance_of_another_shape_or_with_nan_is_refused(problem, wrong):
    with pytest.raises(InvalidPredictionError, match=r"'only': .* shape \(150, 150\)"):
        problem.solve(_Flat({"only": wrong}), 0)
