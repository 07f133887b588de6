"""Recipes and reference values name what exists."""

import configparser
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest
import yaml

from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.reference_files import read_reference
from mocapbench.benchmark.gate.rule import DEFAULT_TOLERANCES, Tolerance
from mocapbench.benchmark.gate.tolerances import read_tolerances
from mocapbench.benchmark.registry import METRICS, TASKS

ROOT = Path(__file__).parents[3]
RECIPES = ROOT / "examples" / "ci"
THIRD_PARTY = ROOT / "examples" / "third-party"
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
GOLDENS = ROOT / "tests" / "goldens" / "metrics"


def tox(folder):
    """Return what the tox.ini of a folder says."""
    read = configparser.ConfigParser(interpolation=None)
    read.read(folder / "tox.ini")
    return read


def commands(folder, environment):
    """Return the commands of an environment of tox."""
    return tox(folder)[f"testenv:{environment}"]["commands"].strip().splitlines()


def environments(path):
    """Return the environments of tox that a recipe runs."""
    found = re.findall(r"tox (?:run|exec) -e ([\w,]+)", path.read_text())
    return {name for names in found for name in names.split(",")}


def uses(path, action):
    """Return what the steps of a workflow give to an action."""
    jobs = yaml.safe_load(path.read_text())["jobs"].values()
    steps = (step for job in jobs for step in job["steps"])
    return [step["with"] for step in steps if step.get("uses", "").startswith(f"{action}@")]


@pytest.mark.parametrize("path", sorted(RECIPES.iterdir()), ids=lambda path: path.stem)
def test_a_recipe_needs_no_other_machine(path):
    assert yaml.safe_load(path.read_text())
    assert "://" not in path.read_text()


def test_recipes_run_every_environment_of_the_example():
    known = {each.strip() for each in tox(THIRD_PARTY)["tox"]["env_list"].split(",")}
    assert environments(RECIPES / "gitlab-ci.yml") == known
    assert environments(RECIPES / "github-actions.yml") == known - {"gate"}  # the action is that


def test_the_action_and_tox_check_the_example_alike():
    (used,) = uses(RECIPES / "github-actions.yml", "mocapbench/mocapbench")
    assert used.keys() <= ACTION["inputs"].keys()
    inputs = {name: each.get("default", "") for name, each in ACTION["inputs"].items()} | used
    run, check = commands(THIRD_PARTY, "gate")
    chosen = " ".join(f"--{name} {inputs[name]}" for name in ("profile", "tasks", "models"))
    assert run == f"mocapbench run {chosen} {inputs['run-arguments']} --out results"
    against = " ".join(f"--{name} {inputs[name]}" for name in ("reference", "tolerances"))
    assert check.startswith(f"mocapbench check results {against} --junit ")
    assert inputs["install"] == "."


def test_the_site_is_published_from_where_it_is_built():
    path = RECIPES / "docs-site.yml"
    assert environments(path) == {"docs"}
    (published,) = uses(path, "actions/upload-pages-artifact")
    build, *_ = commands(ROOT, "docs")
    assert f" docs {published['path']} " in f"{build} "


@pytest.mark.parametrize(
    "path", sorted(filter(Path.is_dir, GOLDENS.iterdir())), ids=lambda p: p.name
)
def test_reference_values_of_ours_name_what_exists(path):
    reference = read_reference(path)
    assert reference.about["profile"] == path.name
    for address, metric in reference.values:
        task = TASKS.get(address.task)
        assert address.version == task.version
        assert address.case in task.profiles[path.name].cases
        assert metric in METRICS.names()


@pytest.mark.parametrize("folder", [GOLDENS, THIRD_PARTY])
@pytest.mark.parametrize("environment", Environment)
def test_every_entry_of_our_tolerances_arrives(folder, environment):
    path = folder / "tolerances.toml"
    table = tomllib.loads(path.read_text()).get(environment, {})
    own = table.pop("metrics", {})
    read, default = read_tolerances(environment, path), DEFAULT_TOLERANCES[environment]
    assert own.keys() <= read.keys() == {*METRICS.names()}
    assert read == {name: replace(default, **{**table, **own.get(name, {})}) for name in read}


def test_our_tolerances_across_platforms_are_not_the_defaults():
    cross, same = (
        read_tolerances(environment, GOLDENS / "tolerances.toml")
        for environment in (Environment.CROSS, Environment.SAME)
    )
    assert cross["mse"] == Tolerance(k=3.0, relative=0.1)
    assert cross["msll"] == Tolerance(k=3.0, relative=0.02, absolute=1e-6)
    assert cross["mlc_best"] == Tolerance(k=3.0, relative=0.02, absolute=0.02)
    assert cross["variance_ratio"] == Tolerance(k=3.0, relative=0.2)
    assert cross["crps"] == DEFAULT_TOLERANCES[Environment.CROSS]
    assert same["mse"] == DEFAULT_TOLERANCES[Environment.SAME]
