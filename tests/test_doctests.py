"""The examples in docstrings run, and what users meet first has some."""

import doctest
import functools
import importlib
import inspect
import pkgutil
import re

import pytest

import mocapbench
from mocapbench import baselines, benchmark, datasets
from mocapbench.benchmark.registry import METRICS, MODELS

OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def _module_names():
    """Return the names of all modules."""
    for module in pkgutil.walk_packages(mocapbench.__path__, "mocapbench."):
        if not module.name.endswith("__main__"):
            yield module.name


def _has_example(name):
    return ">>> " in inspect.getsource(importlib.import_module(name))


def _statistic(name):
    """Return the function that computes a metric, whose docstring explains it."""
    statistic = METRICS.get(name).statistic
    return statistic.func if isinstance(statistic, functools.partial) else statistic


WITH_EXAMPLES = [name for name in _module_names() if _has_example(name)]
MODEL_CLASSES = {name: MODELS.get(name) for name in MODELS.names()}
EXEMPLIFIED = {
    **MODEL_CLASSES,
    **{name: _statistic(name) for name in METRICS.names()},
    **{name: getattr(baselines, name) for name in ("Imputer", "Prediction", "Synthesiser")},
    **{name: getattr(benchmark, name) for name in ("Seeds", "Task")},
    **{
        name: getattr(datasets, name)
        for name in (
            *("Archive", "CMULibrary", "GaitLibrary", "Library", "Recording", "ToyProcess"),
            *("gpdm_features", "hlm_features", "open_archive", "read_motion", "read_skeleton"),
        )
    },
}


@pytest.fixture
def nothing_here(tmp_path, monkeypatch):
    """Examples need no recordings of the user's."""
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path))


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_the_examples_of_a_module_give_what_they_print(name, nothing_here):
    results = doctest.testmod(importlib.import_module(name), optionflags=OPTIONS)
    assert results.attempted > 0
    assert results.failed == 0


@pytest.mark.parametrize("name", EXEMPLIFIED)
def test_what_users_meet_first_has_examples(name):
    assert _has_section(EXEMPLIFIED[name], "Examples")


@pytest.mark.parametrize("name", METRICS.names())
def test_the_example_of_a_metric_names_it(name):
    documented = inspect.getdoc(_statistic(name))
    assert "mocapbench.metrics import" in documented
    assert re.search(rf"\b{name}\b", documented)


@pytest.mark.parametrize("name", MODEL_CLASSES)
def test_a_model_names_its_source(name):
    assert _has_section(MODEL_CLASSES[name], "References")


def _has_section(documented, title):
    underlined = rf"^{title}\n-{{{len(title)}}}$"
    return re.search(underlined, inspect.getdoc(documented) or "", flags=re.MULTILINE) is not None
