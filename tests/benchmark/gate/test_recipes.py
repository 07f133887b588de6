"""Recipes and baselines name what exists."""

import configparser
import re
from pathlib import Path

import pytest
import yaml

from mocapbench.benchmark.gate.reference import read_baseline
from mocapbench.benchmark.gate.rule import Environment
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
def test_a_baseline_of_ours_names_what_exists(path):
    baseline = read_baseline(path)
    assert baseline.about["profile"] == path.name
    for address in baseline.values:
        task = TASKS.get(address.task)
        assert address.version == task.version
        assert address.case in task.profiles[path.name].cases
        assert address.metric in METRICS.names()


@pytest.mark.parametrize("folder", [GOLDENS, ROOT / "examples" / "third-party"])
@pytest.mark.parametrize("environment", Environment)
def test_tolerances_of_ours_are_understood(folder, environment):
    assert read_tolerances(environment, folder / "tolerances.toml").of("mse").k == 3
