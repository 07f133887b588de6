"""Tutorials show what users may rely on; building the site (`tox run -e docs`) executes them."""

import ast
import importlib
from pathlib import Path

import pytest

TUTORIALS = sorted((Path(__file__).parents[1] / "docs" / "tutorials").glob("plot_*.py"))
FRONT_DOORS = {
    "mocapbench",
    "mocapbench.baselines",
    "mocapbench.benchmark",
    "mocapbench.benchmark.testing",
    "mocapbench.datasets",
    "mocapbench.metrics",
    "mocapbench.metrics.statistics",
}


def imports(tutorial):
    """Return the module and the name of everything imported from mocapbench."""
    nodes = ast.walk(ast.parse(tutorial.read_text(encoding="utf-8")))
    sources = [node for node in nodes if isinstance(node, ast.ImportFrom)]
    pairs = {(node.module, alias.name) for node in sources for alias in node.names}
    return {pair for pair in pairs if pair[0].startswith("mocapbench")}


@pytest.mark.parametrize("tutorial", TUTORIALS, ids=lambda path: path.stem)
def test_tutorials_use_public_names_alone(tutorial):
    assert imports(tutorial)
    for module, name in imports(tutorial):
        assert module in FRONT_DOORS
        assert name in importlib.import_module(module).__all__


@pytest.mark.parametrize("tutorial", TUTORIALS, ids=lambda path: path.stem)
def test_tutorials_say_what_to_look_at_and_where_to_go_next(tutorial):
    text = tutorial.read_text(encoding="utf-8")
    assert "# **Look at**" in text
    assert "# Where next\n# ----------\n" in text


@pytest.mark.parametrize("tutorial", TUTORIALS, ids=lambda path: path.stem)
def test_hidden_code_ends_where_a_picture_is_shown(tutorial):
    text = tutorial.read_text(encoding="utf-8")
    begun = text.count("# sphinx_gallery_start_ignore\n")
    assert begun == text.count("plt.show()\n# sphinx_gallery_end_ignore\n") > 0
