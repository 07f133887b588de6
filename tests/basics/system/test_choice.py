"""Which backend is used: as the variable says, or what suits the system."""

import sys
from inspect import signature

import pytest

from mocapbench.basics.system.base import System
from mocapbench.basics.system.choice import UnknownBackendError, find_system
from mocapbench.basics.system.linux import Linux
from mocapbench.basics.system.portable import Portable

ASKED = [name for name in vars(System) if not name.startswith("_")]


@pytest.mark.parametrize(("name", "kind"), [("linux", Linux), ("portable", Portable)])
def test_the_variable_names_the_backend(name, kind, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_BACKEND", name)
    assert type(find_system()) is kind
    assert find_system() is find_system()


@pytest.mark.parametrize(
    ("platform", "kind"), [("linux", Linux), ("darwin", Portable), ("win32", Portable)]
)
def test_by_default_it_is_what_suits_the_system(platform, kind, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_BACKEND", raising=False)
    monkeypatch.setattr(sys, "platform", platform)
    assert type(find_system()) is kind


def test_another_name_is_refused(monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_BACKEND", "windows")
    with pytest.raises(UnknownBackendError, match=r"expected linux or portable .*, got 'windows'"):
        find_system()


@pytest.mark.parametrize("name", ASKED)
def test_both_backends_answer_what_is_asked(name):
    asked = [*signature(getattr(System, name)).parameters]
    assert [*signature(getattr(Linux, name)).parameters] == asked
    assert [*signature(getattr(Portable, name)).parameters] == asked
