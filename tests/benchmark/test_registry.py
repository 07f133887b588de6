import re

import pytest

from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS, Registry, load_model_file

TRIVIAL = "from mocapbench.baselines.trivial import Trivial\n"


@pytest.mark.parametrize("registry", [METRICS, MODELS, TASKS], ids=lambda r: r.kind)
def test_every_registered_name_loads(registry):
    assert registry.names()
    assert all(registry.get(name) is not None for name in registry.names())


@pytest.mark.parametrize(
    ("registry", "wrong", "meant"),
    [
        (MODELS, "cubic-splin", "cubic-spline"),
        (TASKS, "toy-interpolaton-1", "toy-interpolation-1"),
        (METRICS, "msl", "msll"),
    ],
)
def test_an_unknown_name_suggests_the_nearest(registry, wrong, meant):
    advice = re.escape(f"unknown {registry.kind} {wrong!r}: did you mean {meant}")
    with pytest.raises(UnknownNameError, match=advice):
        registry.get(wrong)


def test_a_name_like_no_other_lists_them_all():
    with pytest.raises(UnknownNameError, match=r"known: .*cubic-spline"):
        MODELS.get("@@@@")


def test_order_of_registration_means_nothing():
    one, other = Registry("none"), Registry("none")
    for name in ("b", "a"):
        one.add(name, name)
    for name in ("a", "b"):
        other.add(name, name)
    assert one.names() == other.names() == ("a", "b")


@pytest.mark.parametrize(
    ("source", "complaint"),
    [
        ("def", "cannot be run"),
        ("raise RuntimeError('no')", "cannot be run: RuntimeError: no"),
        ("x = 1", "expected MODELS"),
        ("MODELS = {'a': int}", "expected MODELS"),
        ("MODELS = {}", "expected MODELS"),
        ("import sys; sys.exit(3)", "cannot be run: SystemExit"),
        (f"{TRIVIAL}MODELS = {{'trivial': Trivial}}", "expected a name that no model"),
        (f"{TRIVIAL}MODELS = {{'mohgp-3': Trivial}}", "expected a name that no model"),
        (f"{TRIVIAL}MODELS = {{1: Trivial}}", "expected a name that no model"),
        ("from mocapbench.baselines import Imputer\nMODELS = {'a': Imputer}", "can be built"),
    ],
)
def test_a_model_file_that_is_no_good_says_why(tmp_path, source, complaint):
    path = tmp_path / "models.py"
    path.write_text(source)
    with pytest.raises(UsageError, match=complaint):
        load_model_file(path)


def test_a_model_file_that_is_not_there(tmp_path):
    with pytest.raises(UsageError, match="expected a Python file"):
        load_model_file(tmp_path / "absent.py")
