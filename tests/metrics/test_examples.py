"""The examples of docstrings run, and every registered metric has one."""

import doctest
import pkgutil
from functools import partial
from importlib import import_module
from importlib.metadata import entry_points

import pytest

from mocapbench import metrics

MODULES = [found.name for found in pkgutil.walk_packages(metrics.__path__, "mocapbench.metrics.")]
METRICS = [point.load() for point in entry_points(group="mocapbench.metrics")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_right(name):
    assert doctest.testmod(import_module(name)).failed == 0


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
def test_every_metric_has_an_example_that_names_it(metric):
    statistic = metric.statistic
    function = statistic.func if isinstance(statistic, partial) else statistic
    examples = doctest.DocTestParser().get_examples(function.__doc__)
    assert any("mocapbench.metrics import" in example.source for example in examples)
    assert f"``{metric.name}``" in function.__doc__
