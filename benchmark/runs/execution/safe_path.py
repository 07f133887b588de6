"""Processes of Python that import nothing from the current folder.

By itself, Python looks there first when it starts a process of `multiprocessing`, so that a file
called random.py beside the data would be run in place of the library.
"""

from __future__ import annotations

import os

__all__ = ["SAFE_PATH", "forget_safe_path"]

SAFE_PATH = {"PYTHONSAFEPATH": "mocapbench"}
"""Environment variables of processes that start; any text does, and ours tells who set it."""


def forget_safe_path() -> None:
    """Let programs that this process starts import from their own folder, unless the user forbids.

    Those of a model do: a script finds its helpers beside it.
    """
    for name, value in SAFE_PATH.items():
        if os.environ.get(name) == value:
            del os.environ[name]
