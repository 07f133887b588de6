import pandas as pd
import pytest

from mocapbench.reports.published import published_values
from mocapbench.reports.results import task_results
from mocapbench.reports.scorecard import VERDICTS, scorecard
from mocapbench.reports.verdicts import comparisons


@pytest.fixture
def tasks(bundle):
    return [task_results(bundle, layout) for layout in bundle.layouts]


@pytest.fixture
def data(tasks) -> pd.DataFrame:
    return scorecard(tasks).data


def test_every_published_value_of_the_tasks_is_counted_once(tasks, data):
    for results in tasks:
        own = data[data["task"] == results.layout.name]
        assert own["values"].sum() == len(published_values(results.layout.name))


def test_verdicts_are_those_of_the_comparisons(tasks, data):
    for results in tasks:
        own = data[data["task"] == results.layout.name]
        pairs = [p for metric in results.layout.metrics for p in comparisons(results, metric)]
        for name in VERDICTS:
            assert own[name].sum() == sum(pair.verdict.value == name for pair in pairs)


def test_values_are_answered_or_not_run(tasks, data):
    for results in tasks:
        pairs = [p for metric in results.layout.metrics for p in comparisons(results, metric)]
        answered = {pair.published.address for pair in pairs}
        own = data[data["task"] == results.layout.name]
        assert own["not run"].sum() == own["values"].sum() - len(answered)


def test_a_value_that_two_entrants_answer_counts_for_each(data):
    table_10 = data.set_index("source").loc["thesis-table-10"]
    assert table_10["not run"] == 0
    assert table_10[list(VERDICTS)].sum() == 2 * table_10["values"]


def test_the_page_shows_it_and_offers_it(page):
    assert 'id="scorecard"' in page
    assert "thesis table 10" in page
    assert 'data-table="scorecard"' in page


def test_there_is_none_where_nothing_is_compared(small):
    bundle = small({"a": {"one": [1.0, 2.0]}})
    assert scorecard([task_results(bundle, bundle.layouts[0])]) is None
