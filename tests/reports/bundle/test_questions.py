"""The questions that tasks put to models."""

import pytest

from mocapbench.reports.bundle.questions import BY_KIND, QUESTIONS, question
from mocapbench.reports.bundle.task_page import TaskPage


def _page(**fields):
    return TaskPage(title="T", reference="", description="", metrics=("mse",), **fields)


def test_a_question_has_a_name_of_its_own_and_asks_one_thing():
    assert len({asked.name for asked in QUESTIONS}) == len(QUESTIONS)
    assert all(asked.ask.count("?") == 1 and asked.ask.endswith("?") for asked in QUESTIONS)
    assert [question(asked.name) for asked in QUESTIONS] == list(QUESTIONS)


@pytest.mark.parametrize("kind", BY_KIND)
def test_a_page_that_names_no_question_asks_that_of_its_kind(kind):
    assert _page(kind=kind).question == BY_KIND[kind]
    assert question(BY_KIND[kind])


def test_a_page_keeps_the_question_that_it_names():
    assert _page(question="scattered-samples").question == "scattered-samples"


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"question": "why"}, "question: expected one of hidden-frames, .*got 'why'"),
        ({"kind": "imputes"}, "kind: expected one of impute, .*got 'imputes'"),
    ],
)
def test_an_unknown_question_or_kind_is_named(fields, message):
    with pytest.raises(ValueError, match=message):
        _page(**fields)
