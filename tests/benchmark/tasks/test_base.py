"""What holds for every task: its cases pose pure functions of seeds and recordings."""

from dataclasses import replace
from functools import partial

import joblib
import numpy as np
import pytest

from mocapbench.benchmark import (
    MODELS,
    TASKS,
    Address,
    Case,
    ImputeProblem,
    Profile,
    Seeds,
    Task,
    UnknownNameError,
    archive_at,
    hide_all_but,
)
from mocapbench.datasets import Recording
from mocapbench.reports import TaskPage

NAMES = TASKS.names()


def _pose(task, case, fold=0, root=0):
    address = Address(task.name, task.version, case.problem_name, fold)
    return case.problem(Seeds(root, address), archive_at())


def _smoke(name):
    task = TASKS.get(name)
    return task, task.case(task.profile("smoke").cases[0])


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seeds_pose_the_same_bytes(name):
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    one, two = (joblib.hash(_pose(*_smoke(name))) for _ in range(2))
    assert one == two
    assert (np.random.get_state()[1] == before).all()  # noqa: NPY002


DRAWN = [name for name in NAMES if "true process" in TASKS.get(name).meets]


@pytest.mark.parametrize("name", [*DRAWN, "walking-interpolation"])
def test_another_fold_and_another_root_seed_pose_another_problem(name):
    where = ({}, {"fold": 1}, {"root": 1})
    assert len({joblib.hash(_pose(*_smoke(name), **each)) for each in where}) == 3


@pytest.mark.parametrize("name", NAMES)
def test_cases_of_one_problem_differ_in_their_references_alone(name):
    first = {}
    for case in TASKS.get(name).cases:
        other = first.setdefault(case.problem_name, case)
        assert (case.given, case.parameters) == (other.given, other.parameters)
        assert case is other or case.references != other.references


@pytest.mark.parametrize(
    ("name", "one", "other"),
    [
        ("control-similarity", "synthetic 1 vs synthetic 1", "synthetic 1 vs synthetic 2"),
        pytest.param("walking-synthesis", "35(1)", "12(1)", marks=pytest.mark.recordings),
        pytest.param("soccer-synthesis", "10(5)", "unseen only", marks=pytest.mark.recordings),
    ],
)
def test_models_see_the_same_in_cases_of_one_problem(name, one, other):
    task = TASKS.get(name)
    cases = [task.case(one), task.case(other)]
    if not all(archive_at().available(uri) for case in cases for uri in case.recordings):
        pytest.skip("MOCAPBENCH_DATA names no recordings, or not these")
    seen = [replace(_pose(task, case), references=()) for case in cases]
    assert joblib.hash(seen[0]) == joblib.hash(seen[1])


def _wave(n_visible, seeds, archive):
    values = seeds.generator("data").normal(size=(8, 2))
    wave = Recording("wave", np.arange(8.0), values, ("a", "b"), ("", ""))
    return ImputeProblem.of_one(wave, hide_all_but(seeds.generator("mask"), n_visible, 8, 2))


def _case(name, references=(), problem_name="shared"):
    return Case(name, partial(_wave, 3), references=references, problem_name=problem_name)


TASK = Task(
    name="made-up",
    version=1,
    page=TaskPage(title="Made up", reference="", description="", metrics=("mse",)),
    requires={"fills entries", "fills new recordings"},
    cases=(
        _case("of a", ("x:a",)),
        _case("of b", ("x:b",)),
        _case("of a and b", ("x:a", "x:b")),
        _case("of b and c", ("x:b", "x:c")),
        _case("of another problem", ("x:a", "x:b"), "other"),
    ),
    profiles={"smoke": Profile(("of a",), folds=1)},
)


def test_a_case_has_its_own_name_for_its_problem_unless_it_shares_one():
    assert Case("alone", partial(_wave, 3)).problem_name == "alone"
    assert _case("of a").problem_name == "shared"


def test_recordings_are_named_once_each():
    case = Case("c", partial(_wave, 3), given=("x:a", "x:b"), references=("x:b", "x:c"))
    assert case.recordings == ("x:a", "x:b", "x:c")


def test_a_case_averages_references_that_other_cases_of_its_problem_have_one_by_one():
    averages = {case.name for case in TASK.cases if TASK.averages_references(case)}
    assert averages == {"of a and b"}


def test_cases_and_profiles_are_found_by_name():
    assert TASK.case("of b") is TASK.cases[1]
    assert TASK.profile("smoke").folds == 1
    with pytest.raises(UnknownNameError, match="case of made-up"):
        TASK.case("of d")
    with pytest.raises(UnknownNameError, match="profile of made-up"):
        TASK.profile("quick")


def test_a_task_takes_models_with_all_abilities_and_gives_what_they_need():
    taken = {name for name in MODELS.names() if TASK.accepts(MODELS.get(name))}
    assert "cubic-spline" in taken
    assert not {"mohgp", "oracle", "control", "k-means", "rigid-body"} & taken
    known = replace(TASK, requires={"fills entries"}, meets={"true process"})
    assert known.accepts(MODELS.get("oracle"))
    assert known.accepts(MODELS.get("mohgp"))
    assert replace(known, meets={"coordinates"}).accepts(MODELS.get("rigid-body"))
