"""The house is small enough to be known: one function for each law.

Sizes are measured as in `wc -w` and `wc -l`.
"""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
GENERATED = ("_build", "generated")  # by the site, from docstrings and helps
MOST_WORDS, MOST_WORDS_OF_A_PAGE = 30_000, 2_000


def find_pages():
    """Return the pages that people write: README, CONTRIBUTING, docs, and examples' READMEs."""
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    pages += (ROOT / "examples").rglob("README.md")
    return sorted(page for page in pages if not set(page.parts) & {*GENERATED, ".tox", ".venv"})


def count_words(page):
    return len(page.read_text(encoding="utf-8").split())


def test_the_documentation_has_at_most_30_000_words():
    assert sum(map(count_words, find_pages())) <= MOST_WORDS


@pytest.mark.parametrize("page", find_pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_a_page_has_at_most_2_000_words(page):
    assert count_words(page) <= MOST_WORDS_OF_A_PAGE


def test_contributing_has_at_most_1_000_words():
    assert count_words(ROOT / "CONTRIBUTING.md") <= 1_000


def test_the_changelog_has_at_most_80_lines():
    assert len((ROOT / "CHANGELOG.md").read_text(encoding="utf-8").splitlines()) <= 80
