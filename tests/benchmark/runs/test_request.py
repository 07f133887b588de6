"""Finding cases by what a user types."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.request import matching_cases, split_cases

NAMES = ("35-03 four", "35-03 three", "12-02 three", "test 1", "test 10", "synthetic 1", "a_b")


@pytest.mark.parametrize(
    ("wanted", "found"),
    [
        ("35_03", {"35-03 four", "35-03 three"}),
        ("35-03", {"35-03 four", "35-03 three"}),
        ("35_03 t", {"35-03 three"}),
        ("35_03*four", {"35-03 four"}),
        ("12", {"12-02 three"}),
        ("test 1", {"test 1"}),
        ("test", {"test 1", "test 10"}),
        ("test*", {"test 1", "test 10"}),
        ("*three", {"35-03 three", "12-02 three"}),
        ("a-b", {"a_b"}),
        ("three", set()),
        ("test 11", set()),
    ],
)
def test_a_name_then_a_pattern_then_a_beginning(wanted, found):
    assert set(matching_cases(wanted, NAMES)) == found


@given(st.sampled_from([case.name for name in TASKS.names() for case in TASKS.get(name).cases]))
def test_every_case_is_found_by_its_own_name_alone(name):
    cases = [case.name for task in TASKS.names() for case in TASKS.get(task).cases]
    assert matching_cases(name, cases) == (name,)
    assert matching_cases(name.replace("-", "_"), cases) == (name,)


@given(st.text(max_size=5), st.lists(st.text(max_size=8)))
def test_what_is_found_is_there_once_and_in_order(wanted, names):
    found = matching_cases(wanted, names)
    assert list(found) == [name for name in dict.fromkeys(names) if name in found]


@pytest.mark.parametrize(
    ("typed", "names"),
    [
        ("test 1, test 2", ["test 1", "test 2"]),
        ("a limb 1 s, alone", ["a limb 1 s, alone"]),
        ("test 1,a limb 1 s,alone , test 2", ["test 1", "a limb 1 s, alone", "test 2"]),
        ("a limb*, alone", ["a limb*, alone"]),
        ("a leg, alone", ["a leg", "alone"]),
        (",", []),
    ],
)
def test_commas_separate_cases_but_not_within_the_name_of_one(typed, names):
    known = ("a limb 1 s, alone", "a limb 2 s, alone", "test 1", "test 2")
    assert list(split_cases(typed, known)) == names


@pytest.mark.parametrize("task", TASKS.names())
def test_every_case_can_be_named_alone_and_beside_another(task):
    names = [case.name for case in TASKS.get(task).cases]
    for name in names:
        assert list(split_cases(name, names)) == [name]
        assert list(split_cases(f"{name}, {names[0]}", names)) == [name, names[0]]
