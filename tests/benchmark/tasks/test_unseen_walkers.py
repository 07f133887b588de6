"""Walking of people never seen: who is learnt from, and what samples are compared with."""

import numpy as np
import pytest

from mocapbench.benchmark import TASKS, Address, Seeds, archive_at
from mocapbench.benchmark.tasks.unseen_walkers import (
    APART,
    N_FRAMES,
    N_LEARNT,
    N_REFERENCES,
    N_SAMPLES,
    list_walkers,
)
from mocapbench.datasets import generated_people, read_people

NAME = "unseen-walkers"
CASES = [case for case in TASKS.get(NAME).cases if not case.synthetic]


def test_at_least_ten_people_walk():
    people = read_people()
    persons = {people.person(subject) for subject in list_walkers(people)}
    assert len(persons) >= 10
    assert all(
        "walk" in people.shows(uri) for walks in list_walkers(people).values() for uri in walks
    )


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_no_walk_to_learn_from_is_of_the_reference_or_of_those_tested_with_it(case):
    people = read_people()
    for subject, given, training in zip(
        list_walkers(people), case.given_by_fold, case.training_by_fold, strict=True
    ):
        learnt = training.split()
        assert len(learnt) == len(set(learnt)) == case.columns["recordings"]
        groups = {people.fold(uri.partition(":")[2].partition("_")[0]) for uri in learnt}
        assert people.fold(subject) not in groups
        assert set(given) == {*learnt, *list_walkers(people)[subject]}


def test_fewer_walks_are_the_first_of_more():
    few, many = CASES
    assert [case.columns["recordings"] for case in CASES] == [*N_LEARNT]
    for less, more in zip(few.training_by_fold, many.training_by_fold, strict=True):
        assert more.startswith(less)


@pytest.mark.parametrize("fold", [0, 7])
def test_references_are_the_beginnings_of_walks_then_later_frames_of_them(posed, fold):
    problem, people = posed(NAME, "synthetic 3 walks", fold), generated_people()
    assert 2 <= len(problem.references) <= N_REFERENCES
    assert {reference.shape for reference in problem.references} == {(N_FRAMES, 50)}
    walks = [*list_walkers(people).values()][fold]
    archive = archive_at()
    beginnings = [archive.recording(uri).values[:: people.rate(uri) // 30] for uri in walks]
    n_long = sum(len(values) >= N_FRAMES for values in beginnings[:N_REFERENCES])
    first, later = problem.references[0], problem.references[n_long:][:1]
    for window in later:
        np.testing.assert_array_equal(window[:-APART], first[APART:])
    assert problem.n_samples == N_SAMPLES


def test_a_fold_poses_no_problem_of_another_person():
    task = TASKS.get(NAME)
    problems = [
        task.case("synthetic 3 walks").problem(
            Seeds(0, Address(NAME, task.version, "synthetic 3 walks", fold)), archive_at()
        )
        for fold in (0, 1)
    ]
    assert not np.array_equal(*(problem.references[0] for problem in problems))
