"""The page on paper: everything unfolded, and no column cut off."""

import re
from collections import Counter
from io import BytesIO
from unicodedata import normalize

import pytest

pytestmark = pytest.mark.slow

pypdf = pytest.importorskip("pypdf", reason="pypdf is not installed")

SHOWN = """
tables => tables.map(table => [
  table.id || table.caption?.textContent,
  [...table.querySelectorAll("th, td")].filter(cell => cell.checkVisibility()).flatMap(cell => {
    const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT), texts = [];
    while (walker.nextNode()) {
      const node = walker.currentNode;
      const unseen = node.parentElement.closest(".unseen, svg");
      if (node.data.trim() && !unseen) texts.push(node.data.trim());
    }
    return texts;
  }),
])
"""


def squeezed(text):
    """Return the text without ligatures, and without blanks and breaks, which paper places anew."""
    return re.sub(r"\s+", "", normalize("NFKC", text))


@pytest.fixture(scope="module")
def printed(browser, address):
    """Return the text of the page as printed, and that of its tables on the screen."""
    tab = browser.new_page(viewport={"width": 1280, "height": 900})
    tab.goto(address)
    paper = tab.pdf(prefer_css_page_size=True)
    tab.evaluate("dispatchEvent(new Event('beforeprint'))")
    tab.emulate_media(media="print")
    tables = tab.locator("main table").evaluate_all(SHOWN)
    tab.close()
    pages = pypdf.PdfReader(BytesIO(paper)).pages
    return pages, squeezed("".join(page.extract_text() for page in pages)), tables


def test_every_head_and_number_of_every_table_is_on_paper(printed):
    _, text, tables = printed
    assert len(tables) > 10
    lost = {name: [cell for cell in cells if squeezed(cell) not in text] for name, cells in tables}
    assert {name: cells for name, cells in lost.items() if cells} == {}


def test_numbers_are_on_paper_as_often_as_on_the_page(printed):
    _, text, tables = printed
    cells = Counter(squeezed(cell) for _, cells in tables for cell in cells)
    often = {cell: n for cell, n in cells.items() if re.fullmatch(r"−?\d+\.\d{3,}", cell)}
    assert len(often) > 100
    assert {cell for cell, n in often.items() if text.count(cell) < n} == set()


def test_no_text_is_beyond_the_edge_of_the_paper(printed):
    pages, _, _ = printed
    beyond = []
    for page in pages:
        width = float(page.mediabox.width)

        def note(text, user, matrix, *_, width=width):
            x = matrix[4] * user[0] + matrix[5] * user[2] + user[4]
            if text.strip() and not 0.0 <= x <= width:
                beyond.append(text)

        page.extract_text(visitor_text=note)
    assert beyond == []
