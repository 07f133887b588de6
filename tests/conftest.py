"""Settings of all tests."""

import signal
import sys

import pytest
from hypothesis import settings
from threadpoolctl import threadpool_limits

from mocapbench.benchmark.registry import REGISTRIES

# Linear algebra of tests is small: threads of BLAS would spin on it. Models limit it themselves.
threadpool_limits(1, user_api="blas")

# A deadline would assert a wall-clock time. Properties are tried on the same examples every time;
# `tox run -e properties` searches among others, at random, also where CI is set, for which
# Hypothesis would make every profile repeat itself.
settings.register_profile("random", deadline=None, derandomize=False)
settings.register_profile("same-examples", deadline=None, derandomize=True)
settings.load_profile("same-examples")

# Under nohup, or in the background of a shell, processes would inherit that these are ignored.
signal.signal(signal.SIGHUP, signal.SIG_DFL)
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_itemcollected(item):
    if "browser" in item.fixturenames:
        item.add_marker("browser")


@pytest.fixture(autouse=True)
def registries(monkeypatch):
    """Keep what one test registers from the others, and the folders of its plugins."""
    monkeypatch.setattr(sys, "path", [*sys.path])
    for registry in REGISTRIES:
        monkeypatch.setattr(registry, "_added", dict(registry._added))
