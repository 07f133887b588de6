"""The table of section 13 of docs/inference.md names modules and things that exist."""

from importlib import import_module
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[3] / "docs" / "inference.md"


def _names(cell):
    return [name.strip(" `") for name in cell.split(",")]


def _rows():
    lines = PAGE.read_text(encoding="utf-8").split("## 13.")[1].splitlines()
    cells = [line.rsplit("|", 3)[1:3] for line in lines if line.startswith("| ")]
    return [(_names(modules), _names(names)) for modules, names in cells[1:]]


def _module(path):
    prefix = "" if path.startswith(("common/", "rehearsal/")) else "gp."
    return import_module("mocapbench.baselines." + prefix + path.replace("/", "."))


def _has(module, dotted):
    thing = module
    for name in dotted.split("."):
        if not hasattr(thing, name):
            return False
        thing = getattr(thing, name)
    return True


@pytest.mark.parametrize(("paths", "names"), _rows(), ids=lambda value: value[0])
def test_the_named_modules_have_the_named_things(paths, names):
    modules = [_module(path) for path in paths]
    for name in names:
        assert any(_has(module, name) for module in modules), name
