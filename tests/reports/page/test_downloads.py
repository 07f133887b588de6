import re
from io import StringIO

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.page.downloads import to_csv, to_latex
from mocapbench.reports.page.sections import task_view
from mocapbench.reports.printable import printable
from mocapbench.reports.tables.base import Cell, Table
from mocapbench.reports.tables.scores import score_table

TOKENS = {
    **{f"\\{character}": character for character in "&%$#_{}"},
    **{r"\textbackslash{}": "\\", r"\textasciitilde{}": "~", r"\textasciicircum{}": "^"},
    **{r"\textbar{}": "|", "$<$": "<", "$>$": ">", "{}": ""},
}
"""What LaTeX shows of what is special to it."""
TOKEN = re.compile("|".join(map(re.escape, TOKENS)))
characters = st.characters(codec="utf-8", exclude_characters="±×−–’")
names = st.text(characters) | st.text("\\&%$_{}[*<|\n a")


def shown(latex):
    """Return the text that a line of LaTeX shows; nothing of it may be left to be obeyed."""
    assert not set(TOKEN.sub("", latex)) & set("\\&%$#_{}~^<>|")
    return TOKEN.sub(lambda token: TOKENS[token[0]], latex)


@pytest.fixture(scope="module")
def tables(bundle):
    styles = model_styles(bundle.layouts)
    views = [task_view(task_results(bundle, each), bundle, styles) for each in bundle.layouts]
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


@given(names, names)
def test_latex_shows_names_as_they_are(head, name):
    table = Table("t", "T", (Cell(head),), ((Cell(name),),), pd.DataFrame())
    _, _, heading, _, row, *end = to_latex(table).split("\n")
    assert end == [r"\bottomrule", r"\end{tabular}", ""]
    texts = [shown(line.removesuffix(r" \\")) for line in (heading, row)]
    assert texts == [" ".join(printable(text).split()) for text in (head, name)]


@pytest.mark.parametrize("name", ["[1ex]", "*"])
def test_no_name_is_an_argument_of_the_row_before(name):
    table = Table("t", "T", (Cell(name),), ((Cell(name),), (Cell(name),)), pd.DataFrame())
    assert [line for line in to_latex(table).splitlines() if line.startswith(name)] == []


def test_no_name_begins_a_formula():
    data = pd.DataFrame({"label": ["=1+1", "@sum", "knn"], "mean": [-1.5, 0.5, 2.0]})
    table = Table("t", "T", (), (), data)
    assert to_csv(table) == "label,mean\n'=1+1,-1.5\n'@sum,0.5\nknn,2.0\n"
