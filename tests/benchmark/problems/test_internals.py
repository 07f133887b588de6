"""What models tell of themselves, and the figures made of it."""

import numpy as np
import pytest

from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.oracle import Oracle
from mocapbench.baselines.trivial import Trivial
from mocapbench.benchmark.figures.coregionalisation import coregionalisation_sketch
from mocapbench.benchmark.figures.sketches import sketch
from mocapbench.benchmark.figures.trend import trend_sketch
from mocapbench.benchmark.problems.internals import disclosed
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import open_archive

TOY, WALKING, RECOVERY = (
    TASKS.get(name)
    for name in ("toy-interpolation-3", "walking-interpolation", "covariance-recovery")
)


def _problem(task, case):
    seeds = Seeds(0, task.name, task.version, case, 0)
    return task.problem(task.case(case), seeds, open_archive())


@pytest.fixture(scope="module")
def toy():
    return _problem(TOY, "test 4")


@pytest.fixture(scope="module")
def walking():
    return _problem(WALKING, "synthetic observed 40")


@pytest.fixture(scope="module")
def told(toy):
    model = MOHGP(n_components=2, kernel="rbf", max_iter=3).fit(toy.train)
    return model, disclosed(model, toy.train)


def test_a_model_that_can_tell_its_trend_and_matrices_does(toy, told):
    model, solution = told
    mean, variance = model.trend(toy.train[0].times)
    np.testing.assert_array_equal(solution["trend-mean"], mean)
    np.testing.assert_array_equal(solution["trend-variance"], variance)
    for layer in ("parent", "child"):
        matrices = model.coregionalisation_[layer]
        np.testing.assert_array_equal(solution[f"coregionalisation-{layer}"], matrices)


def test_a_model_tells_what_it_is_able_to_and_no_more(toy):
    oracle = Oracle().inform(toy.process).fit(toy.train)
    assert set(disclosed(oracle, toy.train)) == {"trend-times", "trend-mean", "trend-variance"}
    assert disclosed(Trivial().fit(toy.train), toy.train) == {}


def test_the_trend_is_shown_beside_the_true_parent_with_its_band(toy, told):
    _, solution = told
    (figure,) = trend_sketch(toy, TOY, {"mohgp-1": solution, "trivial": {}})
    (panel,) = figure.panels
    true, inferred = panel.curves
    np.testing.assert_array_equal(true.y, toy.parent.values[:, 0])
    np.testing.assert_array_equal(inferred.y, solution["trend-mean"][:, 0])
    (band,) = panel.bands
    half = 1.96 * np.sqrt(solution["trend-variance"][:, 0])
    np.testing.assert_allclose(band.high - inferred.y, half)
    np.testing.assert_allclose(inferred.y - band.low, half)


def test_no_trend_is_shown_where_the_parent_is_unknown_or_nobody_infers_one(walking, toy, told):
    assert trend_sketch(walking, WALKING, {"mohgp-3": told[1]}) == ()
    assert trend_sketch(toy, TOY, {"trivial": {}}) == ()


@pytest.fixture(scope="module")
def matrices():
    factors = np.random.default_rng(0).normal(size=(3, 39, 2))
    return factors @ factors.transpose(0, 2, 1)


def test_components_of_a_layer_add_up_to_its_correlations(walking, matrices):
    solution = {"coregionalisation-parent": matrices, "coregionalisation-child": 4.0 * matrices}
    whole, leg, _ = coregionalisation_sketch(walking, WALKING, {"mohgp-3": solution})
    assert [each.title for each in whole.maps][:4:3] == [
        "parent, component 1",
        "child, component 1",
    ]
    parent, child = (sum(each.values for each in whole.maps[k : k + 3]) for k in (0, 3))
    np.testing.assert_allclose(np.diag(parent), 1.0)
    np.testing.assert_allclose(parent, child)
    assert set(leg.labels) == {
        *("lfemur.rx", "lfemur.ry", "lfemur.rz", "ltibia.rx", "lfoot.rx", "lfoot.rz")
    }
    places = [walking.train[0].channels.index(channel) for channel in leg.labels]
    for part, of in zip(leg.maps, whole.maps, strict=True):
        np.testing.assert_array_equal(part.values, of.values[np.ix_(places, places)])
    assert whole.labels[places[0]] == "lfemur"


def test_matrices_are_shown_of_the_entrants_that_the_task_names(walking, matrices):
    solution = {"coregionalisation-parent": matrices}
    assert coregionalisation_sketch(walking, WALKING, {"moa-1": solution}) == []


def test_covariances_are_shown_beside_the_true_ones_layer_by_layer():
    problem = _problem(RECOVERY, "correlated outputs")
    both = {f"covariance-{layer}": 2.0 * truth for layer, truth in problem.truth.items()}
    one = {"covariance-child": problem.truth["child"]}
    child, parent = sketch(problem, RECOVERY, {"mohgp": both, "moa": one})
    assert [each.title for each in child.maps] == ["truth", "mohgp", "moa"]
    assert [each.title for each in parent.maps] == ["truth", "mohgp"]
    truth, double, same = (each.values for each in child.maps)
    np.testing.assert_array_equal(double, 2.0 * truth)
    np.testing.assert_array_equal(same, truth)
    every_other = np.concatenate([np.arange(d * 50, d * 50 + 50, 2) for d in range(3)])
    np.testing.assert_array_equal(truth, problem.truth["child"][np.ix_(every_other, every_other)])
    assert child.labels[::25] == ("output-1", "output-2", "output-3")
