"""Links of the documentation lead to files that exist, and the README is short and true."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
METADATA = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
SOURCE = METADATA["urls"]["Source"]
RAW = SOURCE.replace("github.com", "raw.githubusercontent.com") + "/main/"
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]
PAGES += sorted(
    path
    for folder in ("docs", "docs/mathematics", "docs/results")
    for path in (ROOT / folder).glob("*.md")
)


def links(text):
    """Return the targets of inline links and of link definitions, code blocks aside."""
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    inline = re.findall(r"\]\(([^)\s]+)\)", prose)
    return [*inline, *re.findall(r"^\[[^\]]+\]: (\S+)$", prose, re.MULTILINE)]


def test_the_readme_works_on_a_package_index():
    """There, links relative to the source tree lead nowhere."""
    assert links(README)
    assert all(link.startswith("https://") for link in links(README))


def test_every_reference_link_of_the_readme_is_defined_and_used():
    defined = re.findall(r"^\[([^\]]+)\]: ", README, re.MULTILINE)
    assert sorted(set(re.findall(r"\]\[([^\]]+)\]", README))) == sorted(defined)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_links_into_the_source_tree_lead_to_files(page):
    for link in links(page.read_text(encoding="utf-8")):
        path, _, _ = link.partition("#")
        if path.startswith(SOURCE):
            kind, _, name = path.removeprefix(f"{SOURCE}/").partition("/main/")
            target = ROOT / name
            assert kind == ("tree" if target.is_dir() else "blob"), link
        elif path.startswith(RAW):  # pictures
            target = ROOT / path.removeprefix(RAW)
        elif "://" in path or not path:
            continue
        else:
            target = page.parent / path
        assert target.exists(), link


def test_pages_that_the_code_names_exist():
    named = {
        (path, page)
        for top in ("datasets", "metrics", "baselines", "reports", "benchmark", "tests", "docs")
        for path in (ROOT / top).rglob("*.py")
        for page in re.findall(r"\bdocs/[\w/-]+\.md", path.read_text(encoding="utf-8"))
    }
    missing = {(str(path), page) for path, page in named if not (ROOT / page).exists()}
    assert not missing


@pytest.mark.parametrize("name", ["Documentation", "Changelog"])
def test_addresses_of_the_package_index_lead_to_files(name):
    kind, _, path = METADATA["urls"][name].removeprefix(f"{SOURCE}/").partition("/main/")
    assert (ROOT / path).is_dir() == (kind == "tree")
    assert (ROOT / path).exists()


def test_the_readme_counts_what_is_registered():
    (tasks,), (models,) = re.findall(r"(\d+) tasks", README), re.findall(r"(\d+) models", README)
    assert int(tasks) == len(METADATA["entry-points"]["mocapbench.tasks"])
    assert int(models) < len(METADATA["entry-points"]["mocapbench.models"])


def test_the_readme_is_short():
    assert len(README.splitlines()) < 120


@pytest.mark.parametrize(("name", "most"), [("scoreboard.png", 150_000), ("motion.gif", 300_000)])
def test_pictures_of_the_readme_load_quickly(name, most):
    assert 0 < (ROOT / "docs" / "pictures" / name).stat().st_size <= most
