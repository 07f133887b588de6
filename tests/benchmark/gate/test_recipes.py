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
WORKFLOWS = sorted((ROOT / "examples" / "ci").glob("*.yml"))
GOLDENS = ROOT / "tests" / "goldens" / "metrics"


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_runs_environments_that_the_example_has(path):
    text = path.read_text()
    assert yaml.safe_load(text)
    tox = configparser.ConfigParser()
    tox.read(ROOT / "examples" / "third-party" / "tox.ini")
    known = {each.strip() for each in tox["tox"]["env_list"].split(",")}
    used = {name for names in re.findall(r"tox run -e ([\w,]+)", text) for name in names.split(",")}
    assert used == known
    assert "://" not in text


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


@pytest.mark.parametrize("folder", [GOLDENS, ROOT / "examples" / "third-party"])
@pytest.mark.parametrize("environment", Environment)
def test_every_entry_of_our_tolerances_arrives(folder, environment):
    path = folder / "tolerances.toml"
    table = tomllib.loads(path.read_text()).get(environment, {})
    own = table.pop("metrics", {})
    read, default = read_tolerances(environment, path), DEFAULT_TOLERANCES[environment]
    assert read.default == replace(default, **table)
    assert read.by_metric == {
        METRICS.current_name(name): replace(default, **{**table, **options})
        for name, options in own.items()
    }


def test_our_tolerances_across_platforms_are_not_the_defaults():
    cross, same = (
        read_tolerances(environment, GOLDENS / "tolerances.toml")
        for environment in (Environment.CROSS, Environment.SAME)
    )
    assert cross.of("mse") == Tolerance(k=3.0, relative=0.1)
    assert cross.of("msll") == Tolerance(k=3.0, relative=0.02, absolute=1e-6)
    assert cross.of("mlc_best") == Tolerance(k=3.0, relative=0.02, absolute=0.02)
    assert cross.of("variance_ratio") == Tolerance(k=3.0, relative=0.2)  # spread in the file
    assert cross.of("crps") == DEFAULT_TOLERANCES[Environment.CROSS]
    assert same.of("mse") == DEFAULT_TOLERANCES[Environment.SAME]
