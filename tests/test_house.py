"""The house is small enough to be known: one function for each law.

Sizes are measured as in `wc -w` and `wc -l`.
"""

import json
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
GENERATED = ("_build", "generated")  # by the site, from docstrings and helps
FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")
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


def test_no_package_below_the_folders_is_listed_for_the_build():
    hatch = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["hatch"]
    listed = json.dumps(hatch).replace(".", "/")
    packages = {
        path.parent.relative_to(ROOT).as_posix()
        for folder in FOLDERS
        for path in (ROOT / folder).rglob("*/__init__.py")
    }
    assert packages - set(FOLDERS)
    assert [name for name in packages - set(FOLDERS) if name in listed] == []


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="a source distribution has no links")
def test_a_clone_has_the_folders_at_the_top_and_links_to_them_in_the_package():
    package = ROOT / "src" / "mocapbench"
    links = {path.name: path.readlink() for path in package.iterdir() if path.is_symlink()}
    assert links == {folder: Path("..", "..", folder) for folder in FOLDERS}
    assert not any((ROOT / folder).is_symlink() for folder in FOLDERS)
