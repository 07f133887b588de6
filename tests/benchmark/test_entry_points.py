"""In a clone, the entry points that pip wrote down are those of its version, or nothing runs."""

import re
from pathlib import Path

import pytest

from mocapbench.benchmark import entry_points as module
from mocapbench.benchmark.entry_points import find_entry_points, require_up_to_date
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import CALIBRATIONS, REGISTRIES, Registry

PROJECT = Path(__file__).parents[2] / "pyproject.toml"


@pytest.fixture
def clone(tmp_path):
    """Return what writes a clone's list of entry points, with a change, in place of this one's."""

    def write(pattern, replacement):
        text, n_changes = re.subn(pattern, replacement, PROJECT.read_text(encoding="utf-8"))
        assert n_changes == 1
        file = tmp_path / "pyproject.toml"
        file.write_text(text, encoding="utf-8")
        return file

    return write


def test_entry_points_of_this_version_are_taken(clone):
    require_up_to_date(PROJECT)
    require_up_to_date(clone(r'(?m)^description = ".*$', 'description = "Other words"'))


@pytest.mark.parametrize(
    ("pattern", "replacement", "differ"),
    [
        ("(knn = )", r"knn-2 = 'mocapbench.none:KNN'\n\1", "knn-2 (mocapbench.models)"),
        ('(?m)^knn = "mocapbench.*$', "", "knn (mocapbench.models)"),
        ('(?m)^(knn = "mocapbench.*)NN"$', r'\1"', "knn (mocapbench.models)"),
        (r"(?m)^(\[.*)\.calibrations", r"\1.sounds", "(mocapbench.sounds), "),
    ],
    ids=["added", "removed", "moved", "group"],
)
def test_entry_points_of_another_version_are_refused(clone, pattern, replacement, differ):
    expected = "expected the entry points of this version .* differ in .*" + re.escape(differ)
    with pytest.raises(UsageError, match=expected + r".*; run `pip install -e \.` again in"):
        require_up_to_date(clone(pattern, replacement))


def test_a_project_that_has_mocapbench_in_a_folder_of_its_own_is_none_of_ours(clone):
    require_up_to_date(clone('name = "mocapbench"', 'name = "other"'))


@pytest.mark.parametrize("registry", [*REGISTRIES, CALIBRATIONS], ids=lambda one: one.kind)
def test_no_registry_goes_by_entry_points_of_another_version(clone, monkeypatch, registry):
    file = clone(r"(?m)^(\[.*)\.calibrations", r"\1.sounds")
    monkeypatch.setattr(module, "_PROJECT", file)
    with pytest.raises(UsageError, match="again in"):
        Registry(registry.kind, registry.group).names()


def test_an_installation_without_a_clone_has_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_PROJECT", tmp_path / "pyproject.toml")
    assert "knn" in find_entry_points("mocapbench.models")
