"""The version is written once, and what a release consists of agrees with it."""

import json
import re
import tomllib
from pathlib import Path

import pytest
import yaml
from code_attempts import parse
from package_index import COMMANDS

from mocapbench import __version__

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
METADATA = PROJECT["project"]
RECIPE = yaml.safe_load((ROOT / "conda" / "recipe.yaml").read_text())
COPIES = {"CITATION.cff", "conda/recipe.yaml"}  # formats that cannot refer to it


def stated(path):
    """Return the versions that a file states as those of mocapbench, such as ``version: 1.0``."""
    text = path.read_text(encoding="utf-8")
    return re.findall(r"^[\W_]*version[\W_]+(\d+(?:\.\d+)+\w*)", text, re.MULTILINE | re.IGNORECASE)


def test_the_version_is_written_once():
    source = ROOT / PROJECT["tool"]["hatch"]["version"]["path"]
    assert source.samefile(ROOT / "src" / "mocapbench" / "__init__.py")
    assert stated(source) == [__version__]
    others = [path for path in ROOT.iterdir() if path.is_file() and path.name[0] != "."]
    others += [path for name in ("conda", ".ci") for path in (ROOT / name).iterdir()]
    others += [*(ROOT / "docs").glob("*.py"), *(ROOT / "benchmark").rglob("*.py")]
    holding = {path.relative_to(ROOT).as_posix() for path in others if stated(path)}
    assert holding == COPIES
    assert all(stated(ROOT / name) == [__version__] for name in COPIES)


def test_the_changelog_begins_with_what_is_unreleased_and_then_this_version():
    heads = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert heads[0] == "[Unreleased]"
    assert all(re.fullmatch(r"\[\d+\.\d+\.\d+\] - \d{4}-\d{2}-\d{2}", head) for head in heads[1:])
    assert heads[1:2] in ([], [head for head in heads if head.startswith(f"[{__version__}]")])


def test_the_recipe_of_conda_needs_what_the_package_needs():
    needed = [line.replace(">=", " >=") for line in METADATA["dependencies"]]
    lowest = METADATA["requires-python"].removeprefix(">=")
    assert RECIPE["context"]["python_min"] == lowest
    assert RECIPE["requirements"]["run"] == ["python >=${{ python_min }}", *needed]
    (builder,) = PROJECT["build-system"]["requires"]
    assert builder.replace(">=", " >=") in RECIPE["requirements"]["host"]


def test_the_recipe_of_conda_describes_the_package():
    context = RECIPE["context"]
    assert (context["name"], context["version"]) == (METADATA["name"], __version__)
    programs = [f"{name} = {target}" for name, target in METADATA["scripts"].items()]
    assert RECIPE["build"]["python"]["entry_points"] == programs
    about = RECIPE["about"]
    assert about["summary"] == METADATA["description"]
    assert about["license"] == METADATA["license"]
    assert [about["license_file"]] == METADATA["license-files"]
    urls = METADATA["urls"]
    assert about["homepage"] == urls["Homepage"]
    assert about["repository"] == urls["Source"]
    assert about["documentation"] == urls["Documentation"]


def test_the_recipe_of_conda_tries_what_a_release_tries():
    (_, tried) = RECIPE["tests"]
    assert tuple(tried["script"]) == COMMANDS


def test_the_recipe_of_conda_is_rendered_by_the_program_that_builds_it():
    rattler = pytest.importorskip("rattler_build", reason="py-rattler-build is not here")
    (rendered,) = rattler.Stage0Recipe.from_file(ROOT / "conda" / "recipe.yaml").render()
    recipe = rendered.recipe.to_dict()
    assert recipe["package"] == {"name": "mocapbench", "version": __version__}
    lowest = METADATA["requires-python"].removeprefix(">=")
    assert recipe["requirements"]["run"][0] == f"python >={lowest}"
    assert len(recipe["requirements"]["run"]) == len(METADATA["dependencies"]) + 1


def instructions(name):
    """Return what follows each instruction of this name in the Dockerfile."""
    return re.findall(rf"^{name} (.*)$", (ROOT / "Dockerfile").read_text(), re.MULTILINE)


def test_a_container_copies_what_is_here():
    copied = [line.split()[:-1] for line in instructions("COPY") if not line.startswith("--")]
    assert all((ROOT / name).exists() for names in copied for name in names)


def test_a_container_runs_the_benchmark_unless_told_otherwise():
    (entry,), (default,) = map(instructions, ("ENTRYPOINT", "CMD"))
    (program,) = json.loads(entry)
    assert program in METADATA["scripts"]
    assert json.loads(default) == ["run"]
    parse(json.loads(default))


def test_a_container_has_extras_and_a_version_of_python_that_we_declare():
    (extras,) = re.findall(r"whl\)\[(.*)\]", " ".join(instructions("RUN")))
    assert set(extras.split(",")) <= set(METADATA["optional-dependencies"])
    versions = {re.search(r"python:([\d.]+)", line)[1] for line in instructions("FROM")}
    (version,) = versions
    assert f"Programming Language :: Python :: {version}" in METADATA["classifiers"]
