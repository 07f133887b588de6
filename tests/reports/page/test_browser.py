"""The page in a real browser, with the network cut off."""

import pytest

pytestmark = pytest.mark.slow

VIEWS = [(width, scheme) for width in (390, 1280) for scheme in ("light", "dark")]

CONTRAST = """
() => {
  const channel = (c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const parse = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const behind = (node) => {
    for (; node; node = node.parentElement) {
      const colour = parse(getComputedStyle(node).backgroundColor);
      if (colour.length === 3) return colour;
    }
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const faint = [];
  while (walker.nextNode()) {
    const node = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || !node.checkVisibility()) continue;
    const style = getComputedStyle(node);
    const ink = parse(node.closest("svg") ? style.fill : style.color);
    const [high, low] = [light(ink), light(behind(node))].sort((a, b) => b - a);
    if ((high + 0.05) / (low + 0.05) < 4.5) faint.push(walker.currentNode.data.trim());
  }
  return faint;
}
"""

LETTERS = """
drawings => drawings.map(svg => {
  const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
  const sizes = [...svg.querySelectorAll("text")].map(text => getComputedStyle(text).fontSize);
  return scale * Math.min(...sizes.map(parseFloat));
})
"""

PARTS_THAT_BREAK = """
notes => notes.flatMap(note => note.textContent.split("; ").filter(part => {
  const range = document.createRange(), text = note.firstChild;
  const start = text.data.indexOf(part);
  range.setStart(text, start);
  range.setEnd(text, start + part.length);
  return range.getClientRects().length > 1;
}))
"""


def unfold(tab):
    tab.evaluate("document.querySelectorAll('details').forEach(each => { each.open = true })")


@pytest.mark.parametrize(("width", "scheme"), VIEWS)
def test_it_renders_without_complaint_request_or_overflow(visit, width, scheme):
    tab = visit(width, scheme)
    unfold(tab)
    assert tab.complaints == []
    assert tab.evaluate("document.documentElement.scrollWidth") == width


@pytest.mark.parametrize("width", [390, 1280])
def test_a_legend_is_never_cut_and_a_drawing_stays_legible(visit, width):
    tab = visit(width)
    unfold(tab)
    ends = tab.eval_on_selector_all(
        ".legend li", "keys => keys.map(key => key.getBoundingClientRect().right)"
    )
    assert 0 < max(ends) <= width
    sizes = tab.eval_on_selector_all("figure .scroll svg", LETTERS)
    assert min(sizes) >= 9.0


def test_no_interval_of_a_contrast_breaks_on_a_phone(visit):
    tab = visit(390)
    unfold(tab)
    notes = "td.contrast small"
    assert tab.locator(notes).count() > 0
    assert tab.eval_on_selector_all(notes, PARTS_THAT_BREAK) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_has_contrast(visit, scheme):
    tab = visit(scheme=scheme)
    unfold(tab)
    assert tab.evaluate(CONTRAST) == []


def test_the_themes_differ(visit):
    backgrounds = {
        visit(scheme=scheme).evaluate("getComputedStyle(document.body).backgroundColor")
        for scheme in ("light", "dark")
    }
    assert len(backgrounds) == 2


def test_the_first_screen_says_what_was_found(visit):
    tab = visit(width=390)
    answer = tab.locator(".answers article").first.bounding_box()
    assert answer["y"] + answer["height"] < 900


def test_it_reads_without_scripts(visit):
    tab = visit(java_script_enabled=False)
    assert tab.locator("#toy-interpolation-1-mse").is_visible()
    assert tab.locator("figure svg").first.is_visible()
    assert not tab.locator(".downloads").first.is_visible()


def test_a_link_to_a_failure_opens_it(visit):
    tab = visit(fragment="#job-1")
    assert tab.locator("#job-1").get_attribute("open") is not None


def test_the_keyboard_reaches_the_results_first(visit):
    tab = visit()
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.getAttribute('href')") == "#main"


@pytest.mark.parametrize("width", [390, 1280])
def test_model_mean_and_interval_of_every_table_of_scores_are_in_view(visit, width):
    tab = visit(width)
    unfold(tab)
    tab.wait_for_selector("details .scores")
    ends = tab.eval_on_selector_all(
        ".scores :is(th:first-child, .mean, .drawn, .strip)",
        "cells => cells.filter(c => c.checkVisibility()).map(c => c.getBoundingClientRect().right)",
    )
    assert 0 < max(ends) <= width


@pytest.mark.parametrize("width", [390, 1280])
def test_the_bar_covers_no_heading_that_a_link_leads_to(visit, width):
    tab = visit(width, fragment="#task-walking-interpolation", reduced_motion="reduce")
    bar, heading = (
        tab.locator(selector).bounding_box()
        for selector in (".contents", "#task-walking-interpolation")
    )
    assert heading["y"] >= bar["y"] + bar["height"] or heading["y"] + heading["height"] <= bar["y"]


def test_no_head_of_the_scoreboard_is_cut(visit):
    tab = visit()
    cut = tab.eval_on_selector_all(
        "#scoreboard thead th",
        "all => all.filter(th => th.scrollWidth > th.clientWidth + 1).length",
    )
    assert cut == 0
