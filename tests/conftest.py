"""Settings of all tests."""

import sys

import pytest
from hypothesis import settings

from mocapbench.benchmark.registry import REGISTRIES

# A deadline would assert a wall-clock time.
settings.register_profile("no-clock", deadline=None)
settings.load_profile("no-clock")


@pytest.fixture(autouse=True)
def registries(monkeypatch):
    """Keep what one test registers from the others, and the folders of its plugins."""
    monkeypatch.setattr(sys, "path", [*sys.path])
    for registry in REGISTRIES:
        monkeypatch.setattr(registry, "_added", dict(registry._added))
