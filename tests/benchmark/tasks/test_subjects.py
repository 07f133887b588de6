"""Whose recordings the folds of our cases are."""

import pytest

from mocapbench.benchmark import TASKS
from mocapbench.datasets import subject_of

CASES = [(name, case) for name in TASKS.names() for case in TASKS.get(name).cases]
DRAWN_ANEW = {
    *("exaggerated-synthesis", "soccer-synthesis", "walking-synthesis"),
    *("style-clustering", "walking-interpolation"),
}
"""Tasks whose folds, as in the thesis, draw anew on the recordings that all of them have."""


def subjects_of(task):
    return {case.subjects for case in TASKS.get(task).cases if not case.synthetic}


def test_subjects_are_those_of_recordings_of_the_case_and_generated_motion_has_none():
    for name, case in CASES:
        of_recordings = {subject_of(uri) for uri in case.recordings if uri.startswith("cmu:")}
        assert set(case.subjects) <= of_recordings, (name, case.name)
        assert not (case.synthetic and case.subjects)


@pytest.mark.parametrize(
    ("task", "subjects"),
    [
        ("missing-frames", {("35",), ("12",), ("16",), ("07",), ("08",)}),
        ("golf-swings", {("64",)}),
        ("marker-gaps", {("35", "10", "64", "02")}),
        ("upper-body-missing", {("07",)}),
        ("marker-masks", {("135",), ("85",)}),
        ("walking-interpolation", {()}),
    ],
)
def test_the_subjects_of_a_task(task, subjects):
    assert subjects_of(task) == subjects


def test_many_folds_on_one_recording_are_no_units_of_a_lead_over_people():
    counted = {
        name
        for name, case in CASES
        if case.recordings and not (case.synthetic or case.subjects)
        if TASKS.get(name).independent_folds and TASKS.get(name).max_folds != 1
    }
    assert counted == DRAWN_ANEW


def test_a_case_of_several_references_has_no_subject_and_one_of_one_has_that():
    for case in TASKS.get("soccer-synthesis").cases:
        if not case.synthetic:
            (first, *others) = case.references
            assert case.subjects == (() if others else (subject_of(first),))


def test_the_subject_of_an_address():
    assert (subject_of("cmu:35_02"), subject_of("07_01")) == ("35", "07")
    with pytest.raises(ValueError, match="SUBJECT_TRIAL"):
        subject_of("files:walk")
