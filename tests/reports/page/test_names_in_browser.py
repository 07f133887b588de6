"""Names of models and metrics in a real browser: they open, are read and close by keyboard."""

from dataclasses import replace

import pytest

from mocapbench.reports import render
from mocapbench.reports.bundle.model_info import ModelInfo

pytestmark = pytest.mark.slow

SENTENCE = "Interpolate each channel with a smooth curve through its visible frames."
IN_VIEW = """
sheet => {
  const { left, top, right, bottom } = sheet.getBoundingClientRect();
  return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight;
}
"""


@pytest.fixture(scope="module")
def address(bundle, tmp_path_factory):
    spline = ModelInfo("cubic-spline", SENTENCE, "de Boor 2001", "Interpolation", "order=3")
    layouts = tuple(replace(layout, models={"cubic-spline": spline}) for layout in bundle.layouts)
    path = tmp_path_factory.mktemp("names") / "report.html"
    path.write_text(render(replace(bundle, layouts=layouts)), encoding="utf-8")
    return path.as_uri()


@pytest.fixture(params=[(width, script) for width in (390, 1280) for script in (True, False)])
def tab(browser, address, request):
    width, script = request.param
    view = {"width": width, "height": 800}
    context = browser.new_context(viewport=view, java_script_enabled=script)
    tab = context.new_page()
    tab.goto(address)
    yield tab
    context.close()


def test_a_name_opens_by_keyboard_what_is_known_and_escape_closes_it(tab):
    name = tab.locator("tbody .fact", has_text="cubic-spline").first
    sheet = tab.locator("#model-cubic-spline")
    assert not sheet.is_visible()
    name.focus()
    tab.keyboard.press("Enter")
    assert sheet.is_visible()
    assert sheet.evaluate(IN_VIEW)
    for words in (SENTENCE, "de Boor 2001", "Interpolation", "order=3"):
        assert words in sheet.inner_text()
    assert sheet.evaluate("sheet => sheet === document.activeElement")
    tab.keyboard.press("Escape")
    assert not sheet.is_visible()
    assert name.evaluate("name => name === document.activeElement")
