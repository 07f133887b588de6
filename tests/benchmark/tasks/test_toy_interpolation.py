import numpy as np
import pytest

from mocapbench.benchmark import TASKS

ROWS = [
    (name, case.name, {"outputs": 3, "children": 10, "noise": 0.1, "visible": 5, **case.columns})
    for name in ("toy-interpolation-1", "toy-interpolation-2", "toy-interpolation-3")
    for case in TASKS.get(name).cases
]


@pytest.mark.parametrize(("task", "case", "row"), ROWS)
def test_data_are_as_the_row_says(posed, task, case, row):
    problem = posed(task, case)
    assert len(problem.train) == row["children"]
    assert len(problem.given) == (row["children"] if row.get("missing in") == "all" else 1)
    assert problem.train[-len(problem.given) :] == problem.given
    for given, truth in zip(problem.given, problem.truth, strict=True):
        assert given.values.shape == truth.shape == (50, row["outputs"])
        assert (given.visible.sum(axis=0) == row["visible"]).all()
    assert all(child.visible.all() for child in problem.train[: -len(problem.given)])
    assert problem.process.noise == row["noise"]
    n_components = 1 if task == "toy-interpolation-3" else 3
    assert len(problem.process.parent.lengthscales) == n_components


def test_every_fold_draws_a_new_process_new_children_and_a_new_mask(posed):
    one, other = (posed("toy-interpolation-1", "test 1", fold) for fold in (0, 1))
    assert not np.array_equal(one.process.parent.lengthscales, other.process.parent.lengthscales)
    assert not np.array_equal(one.train[0].values, other.train[0].values)
    assert not np.array_equal(one.given[0].visible, other.given[0].visible)


def test_the_true_parent_is_what_the_children_vary_around(posed):
    problem = posed("toy-interpolation-3", "test 4", 1)
    complete = np.mean([child.values for child in problem.train[:-1]], axis=0)
    # Nine children with a variance of .25 and noise of .1 are off by .2 on average.
    assert np.sqrt(np.mean((complete - problem.parent.values) ** 2)) < 2 * 0.2
