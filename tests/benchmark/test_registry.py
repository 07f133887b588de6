import re

import pytest

from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.registry import (
    FORMATS,
    LIBRARIES,
    METRICS,
    MODELS,
    REGISTRIES,
    TASKS,
    Registry,
)


@pytest.mark.parametrize("registry", REGISTRIES, ids=lambda registry: registry.kind)
def test_every_registered_name_loads(registry):
    assert registry.names()
    assert all(registry.get(name) is not None for name in registry.names())
    assert all(registry.is_installed(name) for name in registry.names())


def test_there_are_five_registries():
    assert REGISTRIES == (MODELS, TASKS, METRICS, LIBRARIES, FORMATS)
    kinds = ["model", "task", "metric", "library", "format"]
    assert [registry.kind for registry in REGISTRIES] == kinds


@pytest.mark.parametrize(
    ("registry", "wrong", "meant"),
    [
        (MODELS, "cubic-splin", "cubic-spline"),
        (TASKS, "toy-interpolaton-1", "toy-interpolation-1"),
        (METRICS, "msl", "msll"),
        (LIBRARIES, "giat", "gait"),
        (FORMATS, "parket", "parquet"),
    ],
)
def test_an_unknown_name_suggests_the_nearest(registry, wrong, meant):
    advice = re.escape(f"unknown {registry.kind} {wrong!r}: did you mean {meant}")
    with pytest.raises(UnknownNameError, match=advice):
        registry.get(wrong)


def test_an_unknown_name_may_be_in_a_file_that_was_not_named():
    with pytest.raises(UnknownNameError, match="name that file with --plugin"):
        TASKS.get("mine")


def test_a_name_like_no_other_lists_them_all():
    with pytest.raises(UnknownNameError, match=r"known: .*cubic-spline"):
        MODELS.get("@@@@")


def test_order_of_registration_means_nothing():
    one, other = Registry("none", "mocapbench.none"), Registry("none", "mocapbench.none")
    for name in ("b", "a"):
        one.add(name, name)
    for name in ("a", "b"):
        other.add(name, name)
    assert one.names() == other.names() == ("a", "b")


class _Point:
    value = "no_such_package.module:Model"

    @staticmethod
    def load():
        raise ModuleNotFoundError("No module named 'no_such_package'")


def test_an_entry_point_that_cannot_be_imported_says_so():
    registry = Registry("model", "mocapbench.none")
    registry._points["mine"] = _Point
    expected = (
        "model 'mine' is registered as 'no_such_package.module:Model', which cannot be imported: "
        "ModuleNotFoundError: No module named 'no_such_package'"
    )
    with pytest.raises(UsageError, match=re.escape(expected)):
        registry.get("mine")
