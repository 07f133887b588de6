"""The house is small enough to be known: one function for each law.

Sizes are measured as in `wc -w` and `wc -l`.
"""

import ast
import json
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
GENERATED = ("_build", "generated")  # by the site, from docstrings and helps
FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")
MOST_WORDS, MOST_WORDS_OF_A_PAGE = 30_000, 2_000
CODE = ("metrics", "datasets", "baselines", "reports", "benchmark", "src")
MOST_PARTICIPLES = 0.015  # of all functions
MOST_RECORDS = 200
RECORDS = {"NamedTuple", "TypedDict"}
IRREGULAR = (
    "bound|built|caught|chosen|done|drawn|found|given|gone|grown|held|hidden|hurt|kept|known|laid|led|"
    "left|lost|made|meant|met|paid|said|seen|sent|shown|sold|spent|taken|taught|thought|told|"
    "understood|won|worn|written"
)
VERBS = ["embed", "exceed", "feed", "need", "proceed", "seed", "shed", "speed", "succeed", "wed"]
"""They end like a participle; read, run, split, put, set, cut, let and spread are both."""
NOT_CALLED = {"property", "cached_property"}  # a value of an object, which is what its name says


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


def find_nodes(kind):
    """Yield the nodes of one kind in the syntax trees of the product."""
    for folder in CODE:
        for path in sorted((ROOT / folder).rglob("*.py")):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            yield from (node for node in ast.walk(tree) if isinstance(node, kind))


def find_functions():
    """Yield the functions and methods of the product, but for special methods and properties."""
    for node in find_nodes(ast.FunctionDef):
        marks = {ast.unparse(mark).split(".")[-1] for mark in node.decorator_list}
        if not node.name.startswith("__") and not marks & NOT_CALLED:
            yield node.name


def is_record(node):
    """Return whether the definition of a class is that of a dataclass, or a tuple of names."""
    bases = {ast.unparse(base).split(".")[-1] for base in node.bases}
    return bool(bases & RECORDS) or any("dataclass" in ast.unparse(m) for m in node.decorator_list)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("@dataclass(frozen=True)\nclass A: pass", True),
        ("class A(typing.NamedTuple): pass", True),
        ("class A(TypedDict): pass", True),
        ("@final\nclass A(Base): pass", False),
    ],
)
def test_a_record_is_told_by_what_makes_it_one(code, expected):
    assert is_record(ast.parse(code).body[0]) is expected


def test_the_house_has_at_most_200_records():
    """Where values are unpacked at once, or always travel together, none is needed."""
    records = [node.name for node in find_nodes(ast.ClassDef) if is_record(node)]
    assert records
    assert len(records) <= MOST_RECORDS


def is_bare_participle(name):
    """Return whether a name is a past participle alone, such as "filled", but no verb."""
    word = name.removeprefix("_")
    return word not in VERBS and re.fullmatch(f"[a-z]+ed|{IRREGULAR}", word) is not None


@pytest.mark.parametrize("name", ["filled", "_joined", "_shown", "unwrapped"])
def test_a_past_participle_alone_is_one(name):
    assert is_bare_participle(name)


@pytest.mark.parametrize("name", ["fill_gaps", "read", "_split", "seed", "is_filled", "_by_name"])
def test_a_verb_is_no_participle(name):
    assert not is_bare_participle(name)


def test_at_most_1_5_percent_of_functions_are_named_by_a_participle():
    """They begin with a verb and say what it acts on: `fill_gaps`, not `filled`."""
    names = list(find_functions())
    participles = sorted(filter(is_bare_participle, names))
    assert len(participles) <= MOST_PARTICIPLES * len(names), participles
