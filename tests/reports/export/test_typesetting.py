"""Tables for papers: the numbers and tests of the page, in an order of one's own, ready to compile.

A test that compiles them needs pdflatex with booktabs (Debian: texlive-latex-recommended).
"""

import re
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.reports import latex_text, markdown_text, paper_tables
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.export.latex import escape_latex, figure_latex, table_latex
from mocapbench.reports.export.page_width import fit_page
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.scores.table import score_table
from mocapbench.reports.tables.base import Cell, Table
from mocapbench.reports.text import MINUS

TASKS = ("toy-interpolation-1", "walking-interpolation", "missing-frames")
RISING = [1.0, 1.1, 0.9, 1.05, 0.95, 1.0]
"""Of six folds; others are worse by a constant, or by what is as often more as less."""


def cells_of(tables):
    """Return the cells of tables by (label, head)."""
    return {
        (row[0].text, head.text): cell
        for table in tables
        for row in table.rows
        for head, cell in zip(table.columns[1:], row[1:], strict=True)
    }


def read_row(text, label):
    """Return the means and half widths of a row of LaTeX."""
    (line,) = re.findall(rf"^{label} & (.*)$", text, re.MULTILINE)
    return re.findall(r"\$(?:\\mathbf\{)?([\d.]+)\}?\$ & \$\{\}\\pm ([\d.]+)", line)


@pytest.mark.parametrize("task", TASKS)
def test_numbers_are_those_of_the_page_and_of_the_means(bundle, task):
    means, tables = paper_tables(bundle, [task])
    (layout,) = (layout for layout in bundle.layouts if layout.name == task)
    results, metric = task_results(bundle, layout), layout.page.metrics[0]
    page = score_table(results, metric, model_styles(bundle.layouts))
    heads = [page["mean_head"][0], *(name for name, _ in page["heads"])]
    shown, of_frame = cells_of(tables), means.set_index(["label", "case"])
    compared = 0
    for row in page["rows"]:
        for head, cell in zip(heads, (row.mean, *row.cells), strict=True):
            if row.kind != "published" and cell.value is not None:
                own, number = shown[row.label, head], of_frame.loc[(row.label, head)]
                assert (own.text, own.value) == (cell.text, pytest.approx(cell.value, rel=1e-12))
                assert number["mean"] == own.value
                assert (own.kind == "best") == (cell.kind == "best")
                if row.kind == "ranked" and head == heads[0]:
                    assert (own.mark == "†") == (row.behind.kind == "tied")
                compared += 1
    assert compared == len(means)
    rows = [row.label for row in page["rows"] if row.kind != "published"]
    assert [*dict.fromkeys(means["label"])] == rows


def test_a_half_width_is_that_of_the_page_and_the_same_in_latex_and_markdown(bundle):
    means, tables = paper_tables(bundle, TASKS[:1])
    (layout,) = (layout for layout in bundle.layouts if layout.name == TASKS[0])
    results = task_results(bundle, layout)
    for row in means[~means["case"].str.startswith("mean")].itertuples():
        estimate = results.estimate(row.case, row.label, row.metric)
        assert row.half_width == pytest.approx(estimate.half_width, rel=1e-9)
    text = "".join(map(table_latex, tables))
    places = results.decimals["mse"]
    wanted = means[means["label"] == "mohgp-3"]
    found = [pair for table in tables for pair in read_row(table_latex(table), "mohgp-3")]
    assert [float(mean) for mean, _ in found] == [*np.round(wanted["mean"], places)]
    assert [float(half) for _, half in found] == [*np.round(wanted["half_width"], places)]
    half = f"± {wanted['half_width'].iloc[0]:.{places}f}"
    assert half in markdown_text(tables)
    assert half.replace("±", r"\pm") in text


def test_rows_and_columns_are_those_named_in_that_order(bundle):
    chosen = (["walking-interpolation"], ["observed 10", "observed 40"], ["moa-1", "mohgp-3"])
    means, (table,) = paper_tables(bundle, *chosen)
    assert [row[0].text for row in table.rows] == ["moa-1", "mohgp-3"]
    heads = [head.text for head in table.columns]
    assert heads == ["model", "mean of 2 cases", "observed 10", "observed 40"]
    assert {*means["metric"]} == {"smse_pooled"}
    _, (table,) = paper_tables(bundle, *chosen, ["msll", "mse"])
    assert [head.text for head in table.columns] == ["model", "MSLL", "MSE"]
    means = paper_tables(bundle, ["missing-frames", "toy-interpolation-1"])[0]
    assert [*dict.fromkeys(means["task"])] == ["missing-frames", "toy-interpolation-1"]


def test_a_column_without_a_score_and_a_task_without_one_are_left_out(bundle):
    means, tables = paper_tables(bundle, TASKS, metrics=["mcc", "msll"])
    assert {*means["task"]} == {*TASKS[:2]}
    assert {*means["metric"]} == {"msll"}
    for table in tables:
        for column in [*zip(*table.rows, strict=True)][1:]:
            assert any(cell.value is not None for cell in column)
    cases = {*paper_tables(bundle, ["missing-frames"])[0]["case"]}
    assert not any(case.startswith("12-02") for case in cases)


def test_the_best_of_those_shown_is_bold_and_references_never_are(small):
    values = {"a": {"good": RISING, "fair": [x + 0.5 for x in RISING], "oracle": [0.1] * 6}}
    bundle = small(values)
    _, (table,) = paper_tables(bundle, ["small"])
    kinds = {label: cell.kind for (label, _), cell in cells_of([table]).items()}
    assert kinds == {"good": "best", "fair": "", "oracle": ""}
    assert [row[0].text for row in table.rows][-1] == "oracle"
    assert "Not ranked: oracle." in table.notes
    assert table_latex(table).count(r"\midrule") == 2
    _, (table,) = paper_tables(bundle, ["small"], labels=["fair"])
    assert "best" not in {cell.kind for cell in cells_of([table]).values()}


def test_marks_say_what_may_be_chance_what_is_incomplete_and_what_is_not_tested(small):
    swings = [x + 0.01 * (-1) ** i for i, x in enumerate(RISING)]
    worse = [x + 0.5 for x in RISING]
    full = {"good": RISING, "alike": swings, "worse": worse, "some": [*RISING[:5], np.nan]}
    means, (table,) = paper_tables(small({"a": full}), ["small"])
    marks = {label: cell.mark for (label, _), cell in cells_of([table]).items()}
    assert marks == {"good": "", "alike": "†", "worse": "", "some": "*"}
    tests = means.set_index("label")["test"]
    assert tests["worse"] == "more than chance"
    few = {"a": {label: values[:3] for label, values in full.items()}}
    _, (table,) = paper_tables(small(few), ["small"])
    assert table.columns[1].mark == "‡"
    assert {cell.mark for cell in cells_of([table]).values()} == {""}
    assert any("too few to test" in note for note in table.notes)


def test_a_caption_states_n_and_the_protocol_and_a_label_the_task_and_the_metric(small):
    bundle = small({"a": {"good": RISING, "fair": RISING}}, budget="max_iter=20")
    bundle = replace(bundle, provenance={"profile": "quick", "seed": "3"})
    _, tables = paper_tables(bundle, ["small"])
    text = latex_text(tables, bundle)
    page = bundle.layouts[0].page
    assert f"{page.title} ({page.reference}, profile quick, max\\_iter=20): MSE, lower" in text
    assert "interval by Student’s t over 6 folds" in text
    assert r"\label{tab:small-mse}" in text
    assert "% seed: 3" in text


def grid(n_rows, n_columns):
    heads = tuple(Cell(f"case {n}") for n in range(n_columns))
    cells = tuple(Cell("1.00", spread="0.10", value=1.0) for _ in heads)
    rows = tuple((Cell(f"model {n}"), *cells) for n in range(n_rows))
    return Table("id", "Caption.", (Cell("model"), *heads), rows)


@pytest.mark.parametrize("n_columns", [1, 4, 5, 11, 30])
def test_parts_fit_a_page_and_have_every_column_once(n_columns):
    parts = fit_page(grid(40, n_columns))
    heads = [head.text for part in parts for head in part.columns[1:]]
    assert heads == [f"case {n}" for n in range(n_columns)]
    assert all(len(part.columns) <= 6 for part in parts)
    assert len({part.id for part in parts}) == len(parts) == -(-n_columns // 4)


@pytest.mark.parametrize(("n_rows", "n_columns"), [(1, 2), (3, 12)])
def test_a_table_of_few_models_lies_on_its_side(n_rows, n_columns):
    (table,) = fit_page(grid(n_rows, n_columns))
    assert [row[0].text for row in table.rows] == [f"case {n}" for n in range(n_columns)]
    assert [head.text for head in table.columns[1:]] == [f"model {n}" for n in range(n_rows)]


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
def test_it_compiles_in_a_minimal_document_and_no_line_is_too_long(bundle, small, tmp_path):
    names = [r"50% & $x_1^2$ #{~\a}", "a--b ``c'' <d> | ± † ‡ × ≤ ≥ ° ² §", f"{MINUS}1", "é ø –"]
    hostile = small({name: dict.fromkeys(names, RISING) for name in names})
    texts = []
    for made, tasks in ((bundle, TASKS), (hostile, ["small"])):
        texts.append(latex_text(paper_tables(made, tasks)[1], made))
    texts.extend(figure_latex("a_1-b.pdf", name, f"figure-{n}") for n, name in enumerate(names))
    (tmp_path / "tables.tex").write_text("\n".join(texts), encoding="utf-8")
    packages = "\\usepackage{booktabs}\n\\usepackage[demo]{graphicx}"  # demo: needs no files
    begin = f"\\documentclass{{article}}\n{packages}\n\\begin{{document}}\n"
    (tmp_path / "paper.tex").write_text(f"{begin}\\input{{tables}}\n\\end{{document}}\n")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=120)
    log = done.stdout.decode("utf-8", "replace")
    assert done.returncode == 0, log[-2000:]
    assert "Overfull" not in log


def test_no_two_characters_become_one_and_no_markup_is_left():
    assert escape_latex("a--b") == "a-{}-b"
    assert escape_latex("a - b, c") == "a - b, c"
    assert escape_latex("\\{}") == r"\textbackslash{}\{\}"
    assert escape_latex("x\x1b[31m\ny") == "x y"


def test_the_best_is_said_to_be_bold_only_where_something_is(bundle):
    labels = [*bundle.layouts[0].ranked]
    one, several = (
        paper_tables(bundle, TASKS[:1], (), chosen)[1][0] for chosen in (labels[:1], labels[:3])
    )
    assert "Bold: the best." in several.notes
    assert "Bold: the best." not in one.notes
