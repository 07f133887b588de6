"""Every number of the papers stands beside one of ours, or is said to have no counterpart."""

from collections import Counter
from itertools import groupby

import pytest

from mocapbench.benchmark import TASKS
from mocapbench.benchmark.runs.request import entrants
from mocapbench.reports.paper.published import every_value

VALUES = every_value()
TABLES = {
    address: tuple(values)
    for address, values in groupby(VALUES, lambda value: (value.task, value.source))
}

OF_THEIR_OWN = {
    "subject-35-missing": {
        *(f"GP-LVM (q={q})" for q in (3, 4, 5)),
        "binary latent variable model",
        "scaled NN (two frames, absolute root)",
    },
    **{
        name: {value.model for value in VALUES if value.task == name}
        for name in ("lafan1", "marker-masks", "motion-prediction", "motion-prediction-8-windows")
    },
}
"""Models that have no entrant here: the report shows them as columns of published values."""


def _rows(task):
    """Return the names of published rows that the task's page sets its cases beside."""
    return {*task.page.published_rows.values(), task.page.published_mean}


def _has_counterpart(task, value):
    """Whether a case, a metric and an entrant, or a column of its own, stand for the number's."""
    labels = {entrant.label for entrant in entrants(task)}
    models = {model for label, model in task.page.published_models.items() if label in labels}
    metrics = set(task.page.published_metrics.values())
    placed = value.case in _rows(task) and value.metric in metrics
    return placed and (value.model in models or value.model in OF_THEIR_OWN.get(task.name, ()))


def test_every_number_has_one_address():
    assert set(Counter(value.address for value in VALUES).values()) == {1}


@pytest.mark.parametrize(("name", "source"), TABLES, ids=map(" ".join, TABLES))
def test_every_number_stands_beside_ours_or_is_listed(name, source):
    unlisted = [value for value in TABLES[name, source] if not value.not_comparable]
    lost = [v.address for v in unlisted if not _has_counterpart(TASKS.get(name), v)]
    assert not lost


@pytest.mark.parametrize("name", TASKS.names())
def test_every_counterpart_that_a_task_names_is_printed(name):
    """A misspelt row, metric or model would silently stand beside nothing."""
    task = TASKS.get(name)
    printed = [value for value in VALUES if value.task == name]
    assert _rows(task) - {""} <= {value.case for value in printed}
    assert set(task.page.published_metrics.values()) <= {value.metric for value in printed}
    assert set(task.page.published_models.values()) <= {value.model for value in printed}
