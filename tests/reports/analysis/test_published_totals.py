from collections import Counter

import pytest

from mocapbench.reports.analysis.comparisons import (
    PublishedVerdict,
    answers,
    count_by_source,
    count_published,
    every_comparison,
)
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.paper.published import every_value, published_values

NAN = float("nan")
COMPARED = [
    verdict.value
    for verdict in PublishedVerdict
    if verdict not in (PublishedVerdict.NOT_COMPARABLE, PublishedVerdict.NOT_RUN)
]


@pytest.fixture
def tasks(bundle):
    return [task_results(bundle, layout) for layout in bundle.layouts]


@pytest.mark.parametrize("n_tasks", [0, 1, 3])
def test_totals_add_up_to_the_published_values_whatever_ran(tasks, n_tasks):
    totals = count_published(tasks[:n_tasks])
    assert sum(totals.values()) == len(every_value())
    assert list(totals) == [verdict.value for verdict in PublishedVerdict]
    assert any(totals[verdict] for verdict in COMPARED) == (n_tasks > 0)


def test_totals_are_those_of_the_papers_tables(tasks):
    for results in tasks:
        by_source = count_by_source(results)
        values = published_values(results.layout.name).values()
        expected = Counter(value.source for value in values)
        assert {source: sum(found.values()) for source, found in by_source.items()} == expected


def test_each_value_is_answered_once_and_by_a_comparison_of_its_own(tasks):
    for results in tasks:
        answered, pairs = answers(results), every_comparison(results)
        for address, pair in answered.items():
            assert pair.published.address == address
            assert not pair.reason
        comparable = {pair.published.address for pair in pairs if not pair.reason}
        assert set(answered) == comparable


MODELS = {"mohgp-1": "MOHGP", "mohgp-3": "MOHGP"}


def walking(small, scores, *, labels=("mohgp-1", "mohgp-3"), reasons=None):
    """Return results of one row that is the paper's, whose two entrants stand for one model."""
    bundle = small(
        {"row": {label: [scores[label]] for label in labels}},
        metric="smse_pooled",
        task="walking-interpolation",
        published_rows={"row": "observed 40"},
        not_comparable_rows={("row", label): why for label, why in (reasons or {}).items()},
        published_models=MODELS,
        published_metrics={"smse_pooled": "SMSE"},
    )
    return task_results(bundle, bundle.layouts[0])


def counts_of(results):
    return sum((Counter(found) for found in count_by_source(results).values()), Counter())


def answering(results):
    return {pair.label for pair in answers(results).values()}


@pytest.mark.parametrize(
    "scores", [{"mohgp-1": 0.1, "mohgp-3": 9.0}, {"mohgp-1": 9.0, "mohgp-3": 0.1}]
)
@pytest.mark.parametrize("labels", [("mohgp-1", "mohgp-3"), ("mohgp-3", "mohgp-1")])
def test_which_entrant_answers_depends_on_the_page_and_on_no_score(small, scores, labels):
    results = walking(small, scores, labels=labels)
    assert answering(results) == {"mohgp-1"}
    counts = counts_of(results)
    assert sum(counts[verdict] for verdict in COMPARED) == 1


def test_the_next_answers_where_the_first_has_no_score_or_may_not_be_compared(small):
    assert answering(walking(small, {"mohgp-1": NAN, "mohgp-3": 0.1})) == {"mohgp-3"}
    scores = {"mohgp-1": 0.1, "mohgp-3": 0.1}
    assert answering(walking(small, scores, reasons={"mohgp-1": "other walks"})) == {"mohgp-3"}


def test_a_value_is_not_comparable_only_where_every_reading_has_a_reason(small):
    scores = {"mohgp-1": 0.1, "mohgp-3": NAN}
    counts = counts_of(walking(small, scores, reasons={"mohgp-1": "other walks"}))
    assert (counts["not comparable"], counts["not run"]) == (0, 24)
    counts = counts_of(walking(small, scores, reasons=dict.fromkeys(MODELS, "other walks")))
    assert (counts["not comparable"], counts["not run"]) == (1, 23)
