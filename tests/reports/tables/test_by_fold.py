"""What a paper prints of single folds stands beside ours, and what is better is counted."""

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.tables.by_fold import fold_table

VALUES = {"one": {"a": [1.0, 3.0], "b": [2.0, float("nan")]}, "two": {"a": [1.0, 1.0]}}


def table_of(bundle, metric="mse"):
    return fold_table(task_results(bundle, bundle.layouts[0]), metric)


def texts(table):
    return [[cell.text for cell in row] for row in table.rows]


def test_every_printed_fold_is_a_row_after_a_count_of_those_that_are_better(small):
    table = table_of(small(VALUES, published_folds={"one": (2.0, 2.0)}))
    assert [cell.text for cell in table.columns] == ["fold", "published", "a", "b"]
    assert texts(table) == [
        ["one: better in", "–", "1 of 2", "0 of 1"],
        ["one, fold 0", "2.000", "1.000", "2.000"],
        ["one, fold 1", "2.000", "3.000", "–"],
    ]
    assert [[cell.kind for cell in row] for row in table.rows[1:]] == [
        ["", "published", "best", ""],
        ["", "published", "", "absent"],
    ]


def test_of_a_metric_that_should_be_high_the_higher_is_better(small):
    bundle = small({"one": {"a": [1.0, 3.0]}}, metric="mcc", published_folds={"one": (2.0, 2.0)})
    assert texts(table_of(bundle, "mcc"))[0] == ["one: better in", "–", "1 of 2"]


def test_where_nothing_is_printed_by_fold_there_is_no_table(small):
    assert table_of(small(VALUES)) is None
    assert table_of(small(VALUES, published_folds={"three": (1.0,)})) is None
