"""The questions that tasks put to models."""

import pytest

from mocapbench.reports.bundle.task_page import BY_KIND, QUESTIONS, TaskPage


def _page(**fields):
    return TaskPage(title="T", reference="", description="", metrics=("mse",), **fields)


def test_a_question_has_a_title_of_its_own_and_asks_one_thing():
    titles, asked = zip(*QUESTIONS.values(), strict=True)
    assert len(set(titles)) == len(QUESTIONS)
    assert all(ask.count("?") == 1 and ask.endswith("?") for ask in asked)


@pytest.mark.parametrize("kind", BY_KIND)
def test_a_page_that_names_no_question_asks_that_of_its_kind(kind):
    assert _page(kind=kind).question == BY_KIND[kind]
    assert BY_KIND[kind] in QUESTIONS


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
