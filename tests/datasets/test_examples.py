"""The examples of docstrings run, without a network or files of the user's."""

import doctest
import pkgutil
from importlib import import_module

import pytest

from mocapbench import datasets

MODULES = [found.name for found in pkgutil.walk_packages(datasets.__path__, "mocapbench.datasets.")]
WITH_EXAMPLES = (
    *("Archive", "CMULibrary", "GaitLibrary", "Library", "Recording", "ToyProcess"),
    *("gpdm_features", "hlm_features", "open_archive", "read_motion", "read_skeleton"),
)


@pytest.fixture
def nothing_here(tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path))


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_right(name, nothing_here):
    assert doctest.testmod(import_module(name)).failed == 0


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_the_main_names_have_an_example(name):
    assert doctest.DocTestParser().get_examples(getattr(datasets, name).__doc__)
