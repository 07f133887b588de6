"""The page in use: sort, filter, find, highlight, unfold and save, with the network cut off."""

import csv
import re
from dataclasses import replace
from io import StringIO
from pathlib import Path

import pandas as pd
import pytest

from mocapbench.reports import render
from mocapbench.reports.bundle.model_info import ModelInfo

pytestmark = pytest.mark.slow

TABLE = "#toy-interpolation-1-mse"
TASK = "toy-interpolation-1"
FAMILIES = {
    "Interpolation": ("cubic-spline",),
    "Gaussian processes": ("mohgp-3", "moa-3"),
    "References": ("oracle",),
}
IN_VIEW = """
selector => {
  const { top } = document.querySelector(selector).getBoundingClientRect();
  return top >= 0 && top < innerHeight;
}
"""
LABELS = "rows => rows.map(row => row.dataset.model)"


@pytest.fixture(scope="module")
def page(bundle):
    models = {
        label: ModelInfo(label, family=family) for family, own in FAMILIES.items() for label in own
    }
    layouts = tuple(replace(layout, models=models) for layout in bundle.layouts)
    return render(replace(bundle, layouts=layouts))


@pytest.fixture
def tab(visit):
    tab = visit(accept_downloads=True)
    yield tab
    assert tab.complaints == []


def values(tab, body, column):
    cell = (
        f"row => row.cells[{column}].matches('.incomplete') ? null : row.cells[{column}].dataset.v"
    )
    rows = tab.locator(f"{body} tr[data-model]").evaluate_all(f"rows => rows.map({cell})")
    return [float(value) for value in rows if value is not None]


@pytest.mark.parametrize("column", [1, 4])
def test_a_head_sorts_a_table_of_scores_and_then_the_other_way(tab, column):
    head = tab.locator(f"{TABLE} thead th").nth(column)
    for direction, reverse in (("ascending", False), ("descending", True)):
        head.locator(".sort").click()
        assert head.get_attribute("aria-sort") == direction
        found = values(tab, f"{TABLE} tbody", column)
        assert len(found) > 5
        assert found == sorted(found, reverse=reverse)
    tab.locator(f"{TABLE} thead .sort").first.click()
    names = tab.locator(f"{TABLE} tbody tr").evaluate_all(LABELS)
    assert names == sorted(names)
    assert tab.locator(f"{TABLE} [aria-sort]").count() == 1


def test_what_has_no_score_comes_last_in_both_directions(tab):
    head = tab.locator(f"{TABLE} thead th.case", has_text="test 8").locator(".sort")
    for _ in range(2):
        head.click()
        last = tab.locator(f"{TABLE} tbody tr").last.locator("td").all()
        assert "failed" in last[-2].inner_text() or last[-2].get_attribute("data-v") is None


def test_what_is_incomplete_comes_last_on_the_scoreboard_in_both_directions(tab):
    head = tab.locator("#scoreboard thead tr").nth(1).locator("th").first
    kinds = "rows => rows.map(row => row.cells[1].matches('.incomplete, .none'))"
    for _ in range(2):
        head.locator(".sort").click()
        found = tab.locator("#scoreboard tbody:not(.below) tr[data-model]").evaluate_all(kinds)
        assert found == sorted(found)
    assert tab.locator("#scoreboard tbody:not(.below) td.incomplete").count()
    assert "incomplete: lost folds" in tab.locator(".key").first.inner_text()


def test_a_head_sorts_the_scoreboard_as_one_list_by_keyboard_and_references_stay_below(tab):
    head = tab.locator("#scoreboard thead tr").nth(1).locator("th").first
    for direction, reverse in (("ascending", False), ("descending", True)):
        head.locator(".sort").focus()
        tab.keyboard.press("Enter")
        assert head.get_attribute("aria-sort") == direction
        for part in ("tbody:not(.below)", "tbody.below"):
            found = values(tab, f"#scoreboard {part}", 1)
            assert found == sorted(found, reverse=reverse)
    last = tab.locator("#scoreboard tr[data-model]").last
    assert last.evaluate("row => row.closest('.below') !== null")


def test_one_family_is_shown_also_in_what_is_unfolded_later(tab):
    tab.get_by_label("Show one family of models").select_option("Interpolation")
    summary = tab.locator("details.metric summary").first
    summary.scroll_into_view_if_needed()
    summary.click()
    shown = tab.locator("tr[data-family]:visible").evaluate_all(
        "rs => rs.map(r => r.dataset.family)"
    )
    assert set(shown) == {"Interpolation"}
    assert tab.locator("#toy-interpolation-1-smse-pooled tr[data-family]:visible").count() == 1
    tab.get_by_label("Show one family of models").select_option("all")
    assert tab.locator("#scoreboard tr[data-model=mohgp-3]").is_visible()


def test_a_slash_finds_a_task_and_a_model(tab):
    field = tab.get_by_label("Find a model or a task")
    tab.keyboard.press("/")
    assert field.evaluate("field => field === document.activeElement")
    tab.keyboard.type("Walking interpolation")
    tab.keyboard.press("Enter")
    assert tab.evaluate("location.hash") == "#task-walking-interpolation"
    tab.locator("body").click(position={"x": 2, "y": 2})
    tab.keyboard.press("/")
    tab.keyboard.type("knn")
    tab.keyboard.press("Enter")
    row = tab.locator("#scoreboard tr[data-model=knn]")
    assert row.evaluate("row => row.contains(document.activeElement)")


def test_a_row_highlights_its_model_in_figures_and_escape_clears(tab):
    tab.locator(f"{TABLE} tr[data-model=knn] th").hover()
    dimmed = f"{TABLE} .strip[data-model]:not([data-model=knn])"
    assert set(
        tab.locator(dimmed).evaluate_all("all => all.map(s => getComputedStyle(s).opacity)")
    ) == {"0.15"}
    tab.keyboard.press("Escape")
    assert set(
        tab.locator(dimmed).evaluate_all("all => all.map(s => getComputedStyle(s).opacity)")
    ) == {"1"}


def test_what_is_folded_opens_by_click(tab):
    summary = tab.locator("details.metric summary", has_text="MSLL").first
    assert tab.locator("#toy-interpolation-1-msll").count() == 0
    summary.scroll_into_view_if_needed()
    summary.click()
    tab.locator("#toy-interpolation-1-msll").wait_for()


def test_what_is_folded_opens_by_link(visit, until):
    tab = visit(fragment="#toy-interpolation-1-msll")
    tab.locator("#toy-interpolation-1-msll").wait_for()
    until(tab, IN_VIEW, arg="#toy-interpolation-1-msll")


@pytest.mark.parametrize("reduced", ["reduce", "no-preference"])
def test_the_page_scrolls_smoothly_unless_less_motion_is_asked_for(visit, reduced):
    tab = visit(reduced_motion=reduced)
    behaviour = tab.evaluate("getComputedStyle(document.documentElement).scrollBehavior")
    assert behaviour == ("auto" if reduced == "reduce" else "smooth")


def saved(tab, button):
    with tab.expect_download() as caught:
        button.click()
    return caught.value.suggested_filename, Path(caught.value.path()).read_text(encoding="utf-8")


def shown(tab, attribute=None):
    """Return the means of a table by label, as they stand or in full."""
    read = "row => [row.dataset.model, row.querySelector('td.mean').{}]".format(
        attribute or "innerText"
    )
    return dict(tab.locator(f"{TABLE} tbody tr").evaluate_all(f"rows => rows.map({read})"))


def test_a_table_is_saved_as_csv_with_its_numbers_in_full(tab):
    name, text = saved(tab, tab.locator(f"button[data-table={TABLE[1:]}][data-format=csv]"))
    assert name == f"{TABLE[1:]}.csv"
    head, *rows = csv.reader(StringIO(text))
    assert head[:4] == ["model", "mean of 9 cases", "behind the best", "95 % interval"]
    assert {len(row) for row in rows} == {len(head)}
    full = shown(tab, "dataset.v")
    assert {row[0]: row[1] for row in rows} == full
    interval = tab.locator(f"{TABLE} tr[data-model=moa-3] td.lag small").inner_text()
    assert next(row for row in rows if row[0] == "moa-3")[3] == interval


def test_a_table_is_saved_as_latex_as_it_stands(tab):
    name, text = saved(tab, tab.locator(f"button[data-table={TABLE[1:]}][data-format=tex]"))
    assert name == f"{TABLE[1:]}.tex"
    begin, top, head, middle, *rows, bottom, end, _ = text.split("\n")
    assert begin.startswith(r"\begin{tabular}{lr")
    assert (top, middle, bottom, end) == (
        *(r"\toprule", r"\midrule", r"\bottomrule"),
        r"\end{tabular}",
    )
    assert len({len(re.findall(r"(?<!\\)&", row)) for row in (head, *rows)}) == 1
    cells = [[cell.strip() for cell in row.split("&")] for row in rows]
    assert {row[0]: row[1].replace("$-$", "−") for row in cells} == shown(tab)


def test_all_numbers_are_saved_with_a_row_for_each_value(tab, bundle):
    name, text = saved(tab, tab.get_by_role("button", name="all numbers (CSV)"))
    assert name == "all-numbers.csv"
    keys = ["task", "case", "fold", "label", "metric"]
    found = pd.read_csv(StringIO(text)).set_index(keys)["value"].sort_index()
    on_page = {(each.name, metric) for each in bundle.layouts for metric in each.page.metrics}
    wanted = bundle.scores.set_index(keys)["value"].sort_index()
    wanted = wanted[[(task, metric) in on_page for task, *_, metric in wanted.index]]
    assert len(wanted) > 1000
    pd.testing.assert_series_equal(found, wanted, check_dtype=False, rtol=1e-5)


@pytest.fixture
def hostile(small):
    return render(
        small({"=1+1": {"@sum": [-1.5, 1.0], "a|b_c": [2.0, 3.0]}, "-2": {"@sum": [1.0]}})
    )


def test_no_saved_name_begins_a_formula_or_is_obeyed_by_latex(browser, hostile, tmp_path):
    path = tmp_path / "hostile.html"
    path.write_text(hostile, encoding="utf-8")
    tab = browser.new_page(accept_downloads=True)
    tab.goto(path.as_uri())
    _, text = saved(tab, tab.get_by_role("button", name="all numbers (CSV)"))
    cells = [cell for row in csv.reader(StringIO(text)) for cell in row]
    assert {"'=1+1", "'@sum", "-1.5"} <= set(cells)
    _, latex = saved(tab, tab.locator("button[data-format=tex]").first)
    assert r"a\textbar{}b\_c" in latex
    tab.close()
