import numpy as np
import pytest

from mocapbench.baselines import Layered
from mocapbench.benchmark import METRICS, InvalidPredictionError

METRIC_NAMES = ("frobenius_child", "frobenius_parent", "logdet_child", "logdet_parent")


@pytest.fixture(scope="module")
def problem(posed):
    return posed("covariance-recovery", "correlated outputs")


class _Fixed(Layered):
    """Shows the covariances that it was built with."""

    layers = ("parent", "child")

    def __init__(self, covariances=None):
        self.covariances = covariances

    def fit(self, recordings):
        return self

    def covariance(self, layer, times):
        return self.covariances[layer]


class _Flat(_Fixed):
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
    solution = problem.solve(_Fixed(problem.truth), 0)
    scores = _scores(problem.outcome(solution))
    assert set(scores) == set(METRIC_NAMES)
    assert max(map(abs, scores.values())) < 1e-9


def test_the_one_kernel_of_a_model_without_a_hierarchy_stands_for_the_childrens(problem):
    solution = problem.solve(_Flat({"only": problem.truth["child"]}), 0)
    assert set(solution) == {"child"}
    assert set(_scores(problem.outcome(solution))) == {"frobenius_child", "logdet_child"}


@pytest.mark.parametrize("wrong", [np.eye(3), np.full((150, 150), np.nan)])
def test_a_covariance_of_another_shape_or_with_nan_is_refused(problem, wrong):
    with pytest.raises(InvalidPredictionError, match=r"'only': .* shape \(150, 150\)"):
        problem.solve(_Flat({"only": wrong}), 0)


@pytest.mark.parametrize("layers", [(), ("child",), ("parent", "child"), ("only", "a-b")])
def test_an_answer_survives_the_store(survives, problem, layers):
    matrices = np.random.default_rng(0).normal(size=(len(layers), 6, 6))
    solution, other = (
        dict(zip(layers, matrices, strict=True)),
        {"coregionalisation-child": np.eye(3)},
    )
    assert survives(solution, problem.to_arrays, problem.from_arrays, other)
