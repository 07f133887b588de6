"""Folders say what they hold and are not crowded, and names of classes tell them apart."""

import ast
import re
from collections import defaultdict
from pathlib import Path

import pytest
from folders import find_packages

ROOT = Path(__file__).parents[1]
FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")

MOST_MODULES = 16
LISTS = {
    "baselines": 32,  # one module a model
    "benchmark/cli": 24,  # one module a command
    "benchmark/tasks": 23,  # one module a protocol
    "benchmark/tasks/pages": 18,  # one module a page
    "metrics": 18,  # one module a kind of score
    "baselines/alignment": 17,
}


def holding_modules():
    """Return the folders that hold modules, as paths below the root."""
    return {
        path.parent.relative_to(ROOT).as_posix()
        for top in FOLDERS
        for path in (ROOT / top).rglob("*.py")
    }


def class_homes():
    """Return the modules of every public class, as paths below the root without suffix."""
    homes = defaultdict(list)
    for path in sorted(path for top in FOLDERS for path in (ROOT / top).rglob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes[node.name].append(path.relative_to(ROOT).with_suffix("").as_posix())
    return homes


@pytest.mark.parametrize("folder", sorted(holding_modules()))
def test_a_folder_says_in_one_line_what_it_holds(folder):
    assert dict(find_packages(ROOT))[folder].endswith(".")


@pytest.mark.parametrize("folder", sorted(holding_modules()))
def test_a_folder_is_seen_at_a_glance(folder):
    modules = [path.name for path in (ROOT / folder).glob("[!_]*.py")]
    assert len(modules) <= LISTS.get(folder, MOST_MODULES), modules


@pytest.mark.parametrize(
    "stub", sorted(path for top in FOLDERS for path in (ROOT / top).rglob("__init__.pyi")), ids=str
)
def test_no_package_exports_a_name_that_a_module_of_its_own_has(stub):
    """The module would take the name's place as soon as it is imported."""
    imports = [
        node for node in ast.parse(stub.read_text()).body if isinstance(node, ast.ImportFrom)
    ]
    names = {alias.asname or alias.name for node in imports for alias in node.names}
    assert names
    assert not names & {
        path.stem for path in stub.parent.iterdir() if not path.stem.startswith("_")
    }


def test_unlike_classes_do_not_share_a_name():
    shared = {name: homes for name, homes in class_homes().items() if len(homes) > 1}
    assert shared == {}


def test_every_path_that_the_page_names_exists():
    for path in re.findall(r"`((?:[a-z_]+/)+[a-z_.]*)`", PAGE):
        assert (ROOT / path).exists(), path


@pytest.mark.parametrize("package", sorted((ROOT / "baselines").glob("*/__init__.py")), ids=str)
def test_a_package_of_baselines_names_its_modules(package):
    about = ast.get_docstring(ast.parse(package.read_text(encoding="utf-8"))) or ""
    modules = {path.stem for path in package.parent.glob("[!_]*.py")}
    assert modules <= set(re.findall(r"`(\w+)`", about))
