"""Settings of all tests."""

import signal
import sys

import pytest
from hypothesis import settings

from mocapbench.benchmark.registry import REGISTRIES

# A deadline would assert a wall-clock time.
settings.register_profile("no-clock", deadline=None)
settings.load_profile("no-clock")

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
