"""Which means of the operating system are used: those of Linux, or those that every system has."""

from __future__ import annotations

import importlib
import os
import sys
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    # It imports `multiprocessing`, which must wait until the command line has cleared the path.
    from mocapbench.basics.system.base import System

__all__ = ["UnknownBackendError", "find_system"]

_VARIABLE = "MOCAPBENCH_BACKEND"
_CLASSES = {"linux": "Linux", "portable": "Portable"}
"""By the name of the module, which is imported only where it is used."""


class UnknownBackendError(ValueError):
    """A value of the variable MOCAPBENCH_BACKEND that names no backend of this system."""


def find_system() -> System:
    """Return what the variable MOCAPBENCH_BACKEND names; by default what suits this system.

    Raises
    ------
    UnknownBackendError
        If it names something else.
    """
    suitable = "linux" if sys.platform == "linux" else "portable"
    return _load(os.environ.get(_VARIABLE) or suitable)


@cache
def _load(name: str) -> System:
    known = [*_CLASSES] if sys.platform == "linux" else ["portable"]
    if name not in known:
        raise UnknownBackendError(
            f"{_VARIABLE}: expected {' or '.join(known)} on this system, got {name!r}; correct "
            "the variable, or unset it"
        )
    module = importlib.import_module(f"mocapbench.basics.system.{name}")
    system: System = getattr(module, _CLASSES[name])()
    return system
