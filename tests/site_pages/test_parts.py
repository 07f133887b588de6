"""Folders, styles and values behind the pages."""

import os
import re
import shutil

import pytest
from catalogue.docstrings import described_class, described_function
from catalogue.figures import style_sheet
from catalogue.folder import write_folder
from catalogue.reference import read_today

from mocapbench.baselines import GPDM, LinearImputer
from mocapbench.metrics import mse


def test_a_folder_holds_what_it_is_given_and_no_more(tmp_path):
    write_folder(tmp_path / "pages", {"a.rst": "A", "b.rst": "B"})
    os.utime(tmp_path / "pages" / "a.rst", (1, 1))
    write_folder(tmp_path / "pages", {"a.rst": "A", "c.rst": "C"})
    found = {path.name: path.read_text() for path in (tmp_path / "pages").iterdir()}
    assert found == {"a.rst": "A", "c.rst": "C"}
    assert (tmp_path / "pages" / "a.rst").stat().st_mtime == 1


def test_styles_have_the_colours_of_both_themes():
    sheet = style_sheet()
    light, dark = re.findall(r"[^}]*\.report-figure \{[^}]*--ink[^}]*\}", sheet)
    assert "data-theme=dark" in dark
    assert "data-theme" not in light
    names = [set(re.findall(r"(--[\w-]+):", part)) for part in (light, dark)]
    assert names[0] == names[1]
    used = set(re.findall(r"var\((--[\w-]+)\)", sheet))
    assert {name for name in used if not name.startswith("--pst-")} <= names[0]


@pytest.mark.slow
@pytest.mark.parametrize("lacking", ["golf-swings", "toy-synthesis"])
def test_a_task_that_quick_lacks_is_shown_by_smoke(goldens, tmp_path, lacking):
    copied = shutil.copytree(goldens, tmp_path / "metrics")
    (copied / "quick" / f"{lacking}.csv").unlink()
    tasks = read_today(copied).tasks
    without = {name for name in tasks if not (copied / "quick" / f"{name}.csv").exists()}
    assert lacking in without
    assert {name for name, stored in tasks.items() if stored.profile == "smoke"} == without


def test_without_reference_values_there_are_no_results(tmp_path):
    assert not read_today(tmp_path).tasks


def test_names_in_docstrings_of_ours_are_links_and_in_those_of_others_text():
    assert "`~LinearImputer.fit`" in described_class(LinearImputer).idea

    class Other(LinearImputer):
        """Does as `LinearImputer`, and `fit` the same."""

    assert described_class(Other).idea == "Does as ``LinearImputer``, and ``fit`` the same."


def test_the_parts_of_docstrings():
    model, metric = described_class(GPDM), described_function(mse)
    assert model.idea.startswith("Poses and their dynamics")
    assert "k_Y" in model.formula
    assert ":doc:`/mathematics/gpdm`" in model.formula
    assert model.settings[0].name == "learning"
    assert metric.idea.startswith("The mean of")
    assert metric.pitfalls
    assert metric.example.startswith(">>>")
