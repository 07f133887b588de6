"""The mean of the jobs most alike, whatever the order in which they ended."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.runs.execution.durations import Durations

JOBS = st.lists(st.tuples(st.sampled_from("ab"), st.sampled_from("xy"), st.floats(0, 1e3)))


def _kinds(task, label):
    return (task, label), label, ()


@given(JOBS)
def test_the_mean_of_the_first_kind_of_which_a_job_is_known(jobs):
    durations = Durations()
    for task, label, seconds in jobs:
        durations.learn(_kinds(task, label), seconds)
    for wanted in _kinds("a", "x"):
        alike = [seconds for *kind, seconds in jobs if wanted in _kinds(*kind)]
        if alike:
            assert durations.expect_seconds(_kinds("a", "x")) == pytest.approx(
                sum(alike) / len(alike)
            )
            return
    assert durations.expect_seconds(_kinds("a", "x")) == 0


@given(JOBS)
def test_it_is_known_whether_a_job_of_a_kind_has_ended(jobs):
    durations = Durations()
    for task, label, seconds in jobs:
        durations.learn(_kinds(task, label), seconds)
    assert durations.knows(_kinds("a", "x")) == bool(jobs)
    assert durations.knows(_kinds("a", "x")[:2]) == any(label == "x" for _, label, _ in jobs)
