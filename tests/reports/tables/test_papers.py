import pytest

from mocapbench.reports.analysis.published.totals import published_totals
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


def test_every_row_adds_up_to_its_values(table):
    assert (table.data[list(VERDICTS)].sum(axis=1) == table.data["values"]).all()


def test_the_last_row_counts_all_published_values(tasks, table):
    last = table.data.iloc[-1]
    assert (last["source"], last["values"]) == (ALL, len(every_value()))
    assert last[list(VERDICTS)].to_dict() == published_totals(tasks).counts


def test_a_value_that_two_entrants_answer_counts_once(table):
    table_10 = table.data.set_index("source").loc["thesis-table-10"]
    assert table_10[list(VERDICTS)].sum() == table_10["values"] == 12
    assert table_10["not run"] == 0


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
