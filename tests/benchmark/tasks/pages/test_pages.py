"""A page names cases, entrants, metrics and columns that its task has, and changes no problem."""

from dataclasses import replace

import joblib
import pytest

from mocapbench.benchmark import (
    METRICS,
    TASKS,
    ClusterProblem,
    ImputeProblem,
    RecoverProblem,
    Request,
    SynthesiseProblem,
    archive_at,
    plan,
)
from mocapbench.benchmark.runs.request import entrants
from mocapbench.reports import TaskPage

NAMES = TASKS.names()
KINDS = {
    "impute": ImputeProblem,
    "synthesise": SynthesiseProblem,
    "cluster": ClusterProblem,
    "recover": RecoverProblem,
}
ANOTHER = TaskPage(
    title="Another title",
    reference="nowhere",
    description="Another description.",
    kind="impute",
    metrics=("crps",),
    published_rows={"test 1": "test 9"},
    remarks=("Another remark.",),
)


def _names(values):
    """Return every label that figures name, whatever the figure calls it."""
    return {label for value in values for label in ([value] if isinstance(value, str) else value)}


@pytest.mark.parametrize("name", NAMES)
def test_every_case_that_a_page_names_exists(name):
    task = TASKS.get(name)
    cases = {case.name for case in task.cases}
    assert set(task.page.published_rows) <= cases
    assert {case for case, _ in task.page.not_comparable_rows} <= cases
    assert set(task.page.illustrated) <= cases


@pytest.mark.parametrize("name", NAMES)
def test_every_entrant_that_a_page_names_takes_part(name):
    task = TASKS.get(name)
    page, labels = task.page, {entrant.label for entrant in entrants(task)}
    assert set(page.published_models) <= labels
    assert set(page.exempt) <= labels
    assert {label for label, _ in page.not_comparable} <= labels
    assert {label for _, label in page.not_comparable_rows} <= labels
    fields = [vars(figure) for figure in page.figures]
    assert _names(f[key] for f in fields for key in ("label", "labels") if key in f) <= labels


@pytest.mark.parametrize("name", NAMES)
def test_every_metric_that_a_page_names_exists(name):
    page = TASKS.get(name).page
    assert page.metrics
    assert set(page.metrics) <= set(METRICS.names())
    assert set(page.published_metrics) <= set(page.metrics)
    assert {metric for _, metric in page.not_comparable} <= {"*", *page.published_metrics}


@pytest.mark.parametrize("name", NAMES)
def test_every_column_that_a_page_crosses_is_one_of_every_case(name):
    task = TASKS.get(name)
    assert all(set(task.page.crossed or ()) <= set(case.columns) for case in task.cases)


@pytest.mark.parametrize("name", [name for name in NAMES if TASKS.get(name).page.along])
def test_scores_are_drawn_along_a_column_of_numbers(name):
    task = TASKS.get(name)
    for case in task.cases:
        assert all(isinstance(case.columns[column], int | float) for column in task.page.along)


@pytest.mark.parametrize("name", NAMES)
def test_a_smoke_run_of_a_task_with_figures_shows_them(name):
    task = TASKS.get(name)
    shown = set(task.page.illustrated) & set(task.profile("smoke").cases)
    assert bool(shown) == bool(task.page.figures)


@pytest.fixture(scope="module", params=NAMES)
def smoke(request, posed):
    """Return a task, a case of its smoke profile, and the problem that it poses."""
    task = TASKS.get(request.param)
    case = task.case(task.profile("smoke").cases[0])
    return task, case, posed(task.name, case.name)


def test_the_kind_is_that_of_the_problem(smoke):
    task, _, problem = smoke
    assert isinstance(problem, KINDS[task.page.kind])


def test_another_page_changes_no_problem_and_no_key(posed, smoke):
    task, case, problem = smoke
    request, archive = Request("smoke", (task.name,)), archive_at()
    jobs = plan(request, archive)
    TASKS.add(task.name, replace(task, page=ANOTHER))
    assert plan(request, archive) == jobs
    assert joblib.hash(posed(task.name, case.name)) == joblib.hash(problem)
