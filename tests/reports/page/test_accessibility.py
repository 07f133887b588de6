"""An audit of the page by axe-core, whose script is in the package and needs no network."""

from importlib.resources import files

import pytest

from mocapbench.reports.text import cell_anchor

pytestmark = pytest.mark.slow

pytest.importorskip("axe_playwright_python", reason="axe-playwright-python is not installed")

VIEWS = [(width, scheme) for width in (390, 1280) for scheme in ("light", "dark")]
CELL = f"#{cell_anchor('toy-interpolation-1', 'test 1', 'mohgp-3')}"
UNFOLD = "document.querySelectorAll('details').forEach(each => { each.open = true })"
AUDIT = """
async () => {
  const { violations } = await axe.run(document, { resultTypes: ["violations"] });
  return violations.map(({ id, nodes: [{ target, failureSummary }, ...others] }) =>
    [id, 1 + others.length, target.join(" "), failureSummary]);
}
"""


def violations(tab):
    script = files("axe_playwright_python") / "axe.min.js"
    tab.evaluate(script.read_text(encoding="utf-8"))
    return tab.evaluate(AUDIT)


@pytest.mark.slow
@pytest.mark.parametrize(("width", "scheme"), VIEWS)
def test_nothing_is_violated_with_everything_unfolded(visit, width, scheme):
    tab = visit(width, scheme)
    tab.evaluate(UNFOLD)
    tab.wait_for_selector("details.metric table")
    tab.add_style_tag(content=".task { content-visibility: visible !important }")
    assert violations(tab) == []


@pytest.mark.parametrize(("width", "scheme"), VIEWS)
def test_nothing_is_violated_while_a_cell_is_open(visit, width, scheme):
    tab = visit(width, scheme, fragment=CELL)
    assert tab.locator("#cell").is_visible()
    assert violations(tab) == []
