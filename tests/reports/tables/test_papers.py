import pytest

from mocapbench.reports.analysis.comparisons import count_published
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.paper.published import every_value
from mocapbench.reports.tables.base import ABSENT
from mocapbench.reports.tables.papers import ALL, COUNTS, VERDICTS, papers_table


@pytest.fixture
def tasks(bundle):
    return [task_results(bundle, layout) for layout in bundle.layouts]


@pytest.fixture
def table(tasks):
    return papers_table(tasks)


@pytest.fixture
def counts(table):
    """Return the numbers of each row by their headings, 0 where a dash stands."""
    return {
        row[0].text: {
            name: 0 if cell == ABSENT else int(cell.text)
            for name, cell in zip(COUNTS, row[2:], strict=True)
        }
        for row in table.rows
    }


def test_every_row_adds_up_to_its_values(counts):
    assert len(counts) > 1
    for row in counts.values():
        assert sum(row[verdict] for verdict in VERDICTS) == row["values"]


def test_the_last_row_counts_all_published_values(tasks, counts):
    values, *verdicts = counts[ALL].values()
    assert list(counts)[-1] == ALL
    assert values == len(every_value())
    assert dict(zip(VERDICTS, verdicts, strict=True)) == count_published(tasks)


def test_a_value_that_two_entrants_answer_counts_once(counts):
    table_10 = counts["thesis table 10"]
    assert table_10["values"] == 12
    assert table_10["not run"] == 0


def test_rows_are_as_wide_as_the_headings(table):
    headings = [cell.text for cell in table.columns]
    assert headings == ["published in", "task", *COUNTS]
    assert {len(row) for row in table.rows} == {len(headings)}


def test_the_page_shows_it_and_offers_it(page):
    assert 'id="scorecard"' in page
    assert "thesis table 10" in page
    assert 'data-table="scorecard"' in page


def test_there_is_none_where_nothing_is_compared(small):
    bundle = small({"a": {"one": [1.0, 2.0]}})
    assert papers_table([task_results(bundle, bundle.layouts[0])]) is None
