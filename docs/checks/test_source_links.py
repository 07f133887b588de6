"""Links out of the site lead to the source repository, those between pages stay as they are."""

from pathlib import Path

import pytest
from source_links import with_source_links

PAGES = Path(__file__).parents[1]
ROOT = PAGES.parent
TREE = "https://example.org/tree/main"
BLOB = "https://example.org/blob/main"


@pytest.mark.parametrize(
    ("folder", "link", "led"),
    [
        (PAGES, "../CONTRIBUTING.md", f"{BLOB}/CONTRIBUTING.md"),
        (PAGES, "../CONTRIBUTING.md#add-a-model", f"{BLOB}/CONTRIBUTING.md#add-a-model"),
        (PAGES, "../baselines/gp", f"{TREE}/baselines/gp"),
        (PAGES, "evidence/moa.py", f"{BLOB}/docs/evidence/moa.py"),
        (PAGES / "generated" / "models", "../../../examples", f"{TREE}/examples"),
        (ROOT, "examples", f"{TREE}/examples"),
        (ROOT, "docs/ci.md", "docs/ci.md"),
        (PAGES, "ci.md#the-rule", "ci.md#the-rule"),
        (PAGES, "#sources", "#sources"),
        (PAGES, "../no-such-file", "../no-such-file"),
        (PAGES, "https://example.com", "https://example.com"),
    ],
)
def test_only_what_is_no_page_is_led_to_the_source(folder, link, led):
    text = f"See [`what` is meant]({link}), and again."
    expected = f"See [`what` is meant]({led}), and again."
    assert with_source_links(text, folder, PAGES, "https://example.org") == expected


def test_pictures_stay():
    text = "![growth](scaling.svg)"
    assert with_source_links(text, PAGES, PAGES, "https://example.org") == text
