"""The commands that mocapbench brings along are whole, and are named as models are."""

import sys
from pathlib import Path

import pytest

import mocapbench
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.programs.declaration import (
    find_requirements,
    list_files,
    read_declaration,
)
from mocapbench.benchmark.programs.entrants import (
    find_entrants,
    locate_plugin,
    name_plugin,
    select_entrants,
)
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.testing import check_model

ENTRANTS = find_entrants()
FOLDER = Path(mocapbench.__path__[0]) / "entrants"
SMALL = ("sklearn-iterative", "sklearn-knn")
"""Those whose packages mocapbench needs itself."""


@pytest.fixture(autouse=True)
def nothing_installed(tmp_path, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))


@pytest.mark.parametrize("name", ENTRANTS)
def test_one_has_the_name_of_its_file_and_all_that_a_report_says(name):
    said = read_declaration(ENTRANTS[name])
    assert said.get("name") == name
    assert all(said.get(key) for key in ("summary", "environment", "licence", "source"))
    assert said.get("command")[0] == "python"


@pytest.mark.parametrize("name", ENTRANTS)
def test_packages_are_pinned_but_for_pytorch_of_which_users_have_their_own(name):
    lines = find_requirements(ENTRANTS[name]).read_text().splitlines()
    assert lines == sorted(lines, key=str.lower)
    assert [line for line in lines if "==" not in line] in ([], ["torch>=2.2"])


def test_every_file_belongs_to_one():
    listed = {file for path in ENTRANTS.values() for file in [path, *list_files(path)]}
    there = {path.resolve() for path in FOLDER.rglob("*") if path.is_file()}
    assert {path for path in there if path.suffix != ".pyc"} == listed


@pytest.mark.parametrize("name", ENTRANTS)
def test_none_runs_before_its_packages_are_installed(name):
    with pytest.raises(UsageError, match=f"run `mocapbench models install {name}`"):
        load_plugin(locate_plugin(Path(name)))


def test_a_file_of_the_name_comes_first(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert locate_plugin(Path("gapfill")) == ENTRANTS["gapfill"]
    assert name_plugin(ENTRANTS["gapfill"]) == "gapfill"
    Path("gapfill").touch()
    assert locate_plugin(Path("gapfill")) == tmp_path / "gapfill"
    assert name_plugin(tmp_path / "gapfill") == str(tmp_path / "gapfill")


def test_one_with_another_seed_has_a_number_after_its_name():
    found = select_entrants(["saits-2", "no-such", "linear", "sklearn-knn", "saits"])
    assert found == (ENTRANTS["saits"], ENTRANTS["sklearn-knn"])


@pytest.mark.parametrize("name", SMALL)
def test_models_that_are_named_are_commands_of_ours(name, cli):
    for words in (
        ("run", "--models"),
        ("fill", "walk.csv", "--model"),
        ("list", "models", "--plugin"),
    ):
        assert cli(*words, name) == 2
        assert f"run `mocapbench models install {name}`" in cli.printed
    assert cli("fill", "walk.csv", "--model", f"LKNE=linear,*={name}") == 2
    assert f"run `mocapbench models install {name}`" in cli.printed


def test_all_are_listed_with_what_they_need(cli):
    assert cli("models", "list") == 0
    assert all(name in cli.printed for name in ENTRANTS)


@pytest.fixture
def without_packages(tmp_path):
    """Return a function that declares a command of ours for the Python that runs the tests."""

    def declare(name):
        path = ENTRANTS[name]
        text = path.read_text().replace('"python"', repr(sys.executable))
        copy = tmp_path / path.name
        copy.write_text(text.replace("requirements =", "# requirements ="))
        for file in list_files(path):
            (tmp_path / file.name).write_bytes(file.read_bytes())
        return copy

    return declare


@pytest.mark.slow
@pytest.mark.parametrize("name", SMALL)
def test_a_small_one_keeps_what_its_abilities_promise(name, without_packages):
    load_plugin(without_packages(name))
    check_model(MODELS.get(name))
