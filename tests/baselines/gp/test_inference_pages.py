"""The modules that the pages on exact inference name exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
GP = ROOT / "baselines" / "gp"
HOMES = (GP, GP / "solvers", ROOT / "baselines")
NAMES = ("inference", "solvers", "prediction")
PAGES = [ROOT / "docs" / "mathematics" / f"{name}.md" for name in NAMES]


def find_named_modules(page):
    """Return what the page names between backticks as a path, such as `prior/kernels`."""
    return sorted(set(re.findall(r"`([a-z_]+(?:/[a-z_]+)+/?)`", page.read_text(encoding="utf-8"))))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_modules_that_the_page_names_exist(page):
    named = find_named_modules(page)
    assert named
    for name in named:
        paths = [home / name for home in HOMES] + [ROOT / name]
        assert any(path.is_dir() or path.with_suffix(".py").is_file() for path in paths), name


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_names_of_the_code_that_the_page_names_are_there(page):
    sources = "".join(path.read_text(encoding="utf-8") for path in GP.rglob("*.py"))
    for name in re.findall(r"`([A-Z]\w+)(?:\.\w+)?`", page.read_text(encoding="utf-8")):
        assert re.search(rf"\b{name}\b", sources), name
