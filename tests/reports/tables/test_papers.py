from collections import Counter

import pytest

from mocapbench.reports.analysis.comparisons import every_comparison
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.paper.published import published_values
from mocapbench.reports.tables.base import ABSENT
from mocapbench.reports.tables.papers import COUNTS, NO_SCORE, VERDICTS, papers_table


@pytest.fixture
def tasks(bundle):
    return [task_results(bundle, layout) for layout in bundle.layouts]


@pytest.fixture
def table(tasks):
    return papers_table(tasks)


def test_every_published_value_of_the_tasks_is_counted_under_its_table(tasks, table):
    printed = [each for results in tasks for each in published_values(results.layout.name).values()]
    assert table.data.set_index("source")["values"].to_dict() == Counter(p.source for p in printed)


def test_verdicts_are_those_of_the_comparisons_table_by_table(tasks, table):
    passed = Counter(
        (p.published.source, p.verdict.value) for r in tasks for p in every_comparison(r)
    )
    answered = {pair.published.address for results in tasks for pair in every_comparison(results)}
    values = [v for results in tasks for v in results.published.values()]
    excused = [v for v in values if v.not_comparable and v.address not in answered]
    passed.update((value.source, "not comparable") for value in excused)
    assert excused
    for row in table.data.to_dict("records"):
        for name in VERDICTS:
            assert row[name] == passed[row["source"], name]


def test_a_value_has_a_verdict_or_a_reason_or_no_score_of_ours(tasks, table):
    for results in tasks:
        answered = {pair.published.address for pair in every_comparison(results)}
        left = Counter(
            value.source
            for value in results.published.values()
            if value.address not in answered and not value.not_comparable
        )
        own = table.data[table.data["task"] == results.layout.name].set_index("source")
        assert own[NO_SCORE].to_dict() == {source: left[source] for source in own.index}


def test_a_value_that_two_entrants_answer_counts_for_each(table):
    table_10 = table.data.set_index("source").loc["thesis-table-10"]
    assert table_10[NO_SCORE] == 0
    assert table_10[list(VERDICTS)].sum() == 2 * table_10["values"]


def test_cells_stand_under_their_headings(table):
    headings = [cell.text for cell in table.columns]
    assert headings == ["published in", "task", *COUNTS]
    for cells, row in zip(table.rows, table.data.to_dict("records"), strict=True):
        shown = dict(zip(headings, cells, strict=True))
        assert shown["task"].text == row["task"]
        for name in COUNTS:
            assert shown[name].text == (str(row[name]) if row[name] else ABSENT.text)


def test_the_page_shows_it_and_offers_it(page):
    assert 'id="scorecard"' in page
    assert "thesis table 10" in page
    assert 'data-table="scorecard"' in page


def test_there_is_none_where_nothing_is_compared(small):
    bundle = small({"a": {"one": [1.0, 2.0]}})
    assert papers_table([task_results(bundle, bundle.layouts[0])]) is None
