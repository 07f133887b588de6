"""Every code block of the README and of the documentation works."""

from pathlib import Path

import pytest
from code_blocks import code_blocks
from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
PAGES += sorted([*(ROOT / "docs/mathematics").glob("*.md"), *(ROOT / "docs/results").glob("*.md")])
PAGES += sorted((ROOT / "examples").glob("*/README.md"))


def name_of(page):
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_no_block_goes_unseen(page):
    tokens = MarkdownIt("commonmark").parse(page.read_text(encoding="utf-8"))
    found = [example.parsed.split() for example in code_blocks(page)]
    assert found == [token.content.split() for token in tokens if token.type == "fence"]
    assert not any(token.type == "code_block" for token in tokens)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in PAGES if "```" in page.read_text()], ids=name_of)
def test_the_code_blocks_of_a_page_work(page, desk):
    for example in code_blocks(page):
        example.evaluate()
