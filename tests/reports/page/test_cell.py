"""The dialog of a cell in a real browser."""

from dataclasses import replace

import pytest

from mocapbench.reports import Origin, render
from mocapbench.reports.text import cell_anchor

expect = pytest.importorskip("playwright.sync_api", reason="playwright is not installed").expect

TASK, CASE, LABEL = "toy-interpolation-1", "test 1", "mohgp-3"
ANCHOR = f"#{cell_anchor(TASK, CASE, LABEL)}"
COMMAND = ("mocapbench run --seed 0", "--cases 'it'\"'\"'s <b>'", "--folds 5")


@pytest.fixture(scope="module")
def page(bundle):
    origin = Origin(COMMAND, 0, {fold: f"{fold:064x}" for fold in range(5)}, {"cmu:07_01": "abc"})
    return render(replace(bundle, origins={(TASK, CASE, LABEL): origin}))


def expect_title(tab, title):
    """The dialog opens, or changes, after the address has."""
    expect(tab.locator("#cell-title")).to_have_text(title)


def is_open(tab):
    return tab.evaluate("document.getElementById('cell').open")


@pytest.mark.parametrize("width", [390, 1280])
def test_an_address_opens_its_cell(visit, bundle, width):
    tab = visit(width=width, fragment=ANCHOR)
    expect_title(tab, f"{LABEL} · {CASE}")
    scores = bundle.scores
    here = scores[(scores["task"] == TASK) & (scores["case"] == CASE) & (scores["label"] == LABEL)]
    shown = tab.locator("[data-cell=folds] tr td:nth-child(4)").all_inner_texts()
    wanted = here[here["metric"] == "smse_pooled"]["value"].tolist()
    assert [float(text.replace("−", "-")) for text in shown] == pytest.approx(wanted, rel=1e-3)
    assert tab.locator("[data-cell=command]").inner_text() == " ".join(COMMAND)
    assert tab.locator("[data-cell=scores] circle").count() == 3 * 5
    assert tab.evaluate("document.documentElement.scrollWidth") == width
    assert tab.complaints == []


def test_every_score_opens_its_own_cell(visit, bundle):
    tab = visit()
    links = tab.eval_on_selector_all("a[href^='#cell=']", "all => all.map(a => a.hash)")
    records = bundle.records[["task", "case", "label"]].drop_duplicates()
    known = [*records.itertuples(index=False, name=None)]
    of_means = [(task, "", label) for task, _, label in known]
    assert set(links) <= {f"#{cell_anchor(*names)}" for names in (*known, *of_means)}
    assert len(set(links)) > 100
    tab.locator("#toy-interpolation-1-mse tr[data-model=moa-3] a[href^='#cell=']").nth(2).click()
    expect_title(tab, "moa-3 · test 2")


@pytest.mark.parametrize("table", ["#scoreboard", "#toy-interpolation-1-mse"])
def test_a_mean_opens_the_first_case_of_its_model_and_leads_to_the_others(
    visit, bundle, table, until
):
    tab = visit()
    mean = f"{table} a[href='#{cell_anchor(TASK, '', LABEL)}']"
    tab.locator(mean).click()
    expect_title(tab, f"{LABEL} · {CASE}")
    cases = tab.get_by_role("navigation", name="Cases of this model").get_by_role("link")
    assert cases.all_inner_texts() == [case.name for case in bundle.layouts[0].cases]
    cases.nth(3).click()
    expect_title(tab, f"{LABEL} · test 4")
    assert cases.nth(3).get_attribute("aria-current") == "true"
    tab.keyboard.press("Escape")
    until(tab, "!document.getElementById('cell').open")
    assert tab.locator(mean).evaluate("link => link === document.activeElement")


@pytest.mark.parametrize("key", ["Escape", "back", "Close"])
def test_closing_brings_back_place_address_and_focus(visit, key, until):
    tab = visit(fragment="#provenance", reduced_motion="reduce")
    link = tab.locator("#toy-interpolation-1-mse a[href^='#cell=']").first
    link.scroll_into_view_if_needed()
    link.focus()
    anchor = link.get_attribute("href")
    before = tab.evaluate("scrollY")
    tab.keyboard.press("Enter")
    tab.locator("[data-cell=next]").click()
    tab.locator("[data-cell=next]").click()
    assert tab.evaluate("location.hash") not in {"#provenance", anchor}
    if key == "Escape":
        tab.keyboard.press("Escape")
    elif key == "back":
        tab.go_back()
    else:
        tab.get_by_role("button", name="Close").click()
    until(tab, "!document.getElementById('cell').open")
    assert tab.evaluate("location.hash") == "#provenance"
    until(tab, "top => scrollY === top", arg=before)
    assert tab.evaluate("document.activeElement.hash") == anchor


def test_closing_a_page_that_began_with_a_cell_leaves_no_address(visit):
    tab = visit(fragment=ANCHOR)
    tab.keyboard.press("Escape")
    assert not is_open(tab)
    assert tab.evaluate("location.hash") == ""


@pytest.mark.parametrize(
    "fragment", ["#cell=a/b/c", "#cell=", "#cell=%", f"{ANCHOR}x", "#cell=__proto__/a/b"]
)
def test_an_unknown_cell_is_told(visit, fragment):
    tab = visit(fragment=fragment)
    expect_title(tab, "No such cell")
    assert not tab.locator("[data-cell=command]").is_visible()
    assert tab.complaints == []


def test_a_failed_fold_says_why_and_leads_to_the_failure(visit, until):
    tab = visit(fragment=f"#{cell_anchor('walking-interpolation', 'observed 10', 'mohgp-3')}")
    row = tab.locator("[data-cell=folds] tr").nth(2)
    assert "LinAlgError" in row.inner_text()
    row.get_by_role("link", name="failed").click()
    until(tab, "!document.getElementById('cell').open")
    assert tab.locator(tab.evaluate("location.hash")).get_attribute("open") is not None


def test_the_command_is_copied_or_else_selected(visit, until):
    tab = visit(fragment=ANCHOR)
    tab.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject() }")
    tab.locator("[data-cell=copy]").click()
    until(tab, "document.querySelector('[data-cell=copied]').textContent")
    assert tab.evaluate("getSelection().toString()") == " ".join(COMMAND)
    copied = []
    tab.expose_function("keep", lambda text: copied.append(text))  # noqa: PLW0108
    tab.evaluate("() => { navigator.clipboard.writeText = (text) => keep(text) }")
    tab.locator("[data-cell=copy]").click()
    until(tab, "document.querySelector('[data-cell=copied]').textContent === 'Copied.'")
    assert copied == [" ".join(COMMAND)]


def test_without_scripts_a_score_is_a_score(visit):
    tab = visit(java_script_enabled=False, fragment=ANCHOR)
    assert tab.locator("#toy-interpolation-1-mse").is_visible()
    assert not tab.locator("#cell").is_visible()
