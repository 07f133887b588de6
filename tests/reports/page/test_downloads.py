from io import StringIO

import pandas as pd
import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.page.downloads import to_csv, to_latex
from mocapbench.reports.page.sections import task_view
from mocapbench.reports.tables.base import Cell, Table
from mocapbench.reports.tables.scores import score_table


@pytest.fixture(scope="module")
def tables(bundle):
    views = [task_view(task_results(bundle, layout)) for layout in bundle.layouts]
    return [table for view in views for table in view.tables]


def test_csv_reads_back_as_the_data(tables):
    for table in tables:
        read = pd.read_csv(StringIO(to_csv(table)), keep_default_na=True)
        assert list(read) == list(table.data)
        assert len(read) == len(table.data)


def test_csv_loses_no_digit(bundle):
    table = score_table(task_results(bundle, bundle.layouts[0]), "mse")
    read = pd.read_csv(StringIO(to_csv(table)))
    assert read["mean"].to_numpy() == pytest.approx(table.data["mean"], rel=1e-15, nan_ok=True)


def test_latex_has_as_many_columns_in_every_row(tables):
    for table in tables:
        body = [line for line in to_latex(table).splitlines() if line.endswith(r"\\")]
        plain = [line.replace(r"\&", "") for line in body]
        assert {line.count("&") for line in plain} == {len(table.columns) - 1}


def test_latex_escapes_names_and_sets_the_best_in_bold():
    cells = (Cell("a_b & c% < 1"), Cell("−1.0", spread="0.5", kind="best"))
    table = Table("t", "T", (Cell("na#me"), Cell(r"x\y")), (cells,), pd.DataFrame())
    text = to_latex(table)
    assert r"a\_b \& c\% $<$ 1" in text
    assert r"\textbf{$-$1.0 $\pm$ 0.5}" in text
    assert r"na\#me" in text
    assert r"x\textbackslash{}y" in text


def test_no_name_begins_a_formula():
    data = pd.DataFrame({"label": ["=1+1", "@sum", "knn"], "mean": [-1.5, 0.5, 2.0]})
    table = Table("t", "T", (), (), data)
    assert to_csv(table) == "label,mean\n'=1+1,-1.5\n'@sum,0.5\nknn,2.0\n"
