"""Which modules are a user's own code: neither of the standard library nor of an installed package.

Their files can change at any time, and no version says that they did.
"""

from __future__ import annotations

import sys
import sysconfig
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

__all__ = ["folders_of", "is_own_code"]

_INSTALLED = {"site-packages", "dist-packages"}
_STANDARD = {Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib")}


@cache
def is_own_code(name: str) -> bool:
    """Return whether a top-level module or package is a user's own, also if installed as editable.

    Parameters
    ----------
    name : str
        Its name, without a dot. It is not imported.
    """
    return not all(
        _is_standard(folder) or _is_installed(name, folder) for folder in folders_of(name)
    )


@cache
def folders_of(name: str) -> frozenset[Path]:
    """Return the folders that a top-level module or package lies in; none if there is no file."""
    return frozenset(Path(place).resolve().parent for place in _places(name))


def _places(name: str) -> Iterable[str]:
    """Return the file of a module, or the folders of a package."""
    module = sys.modules.get(name)
    if module is not None:
        file = getattr(module, "__file__", None)
        return getattr(module, "__path__", None) or ([file] if file else [])
    try:
        spec = find_spec(name)
    except (ImportError, ValueError):
        return []
    if spec is None or not (spec.has_location or spec.submodule_search_locations):
        return []
    return spec.submodule_search_locations or [str(spec.origin)]


def _is_standard(folder: Path) -> bool:
    return not _STANDARD.isdisjoint((folder, *folder.parents))


def _is_installed(name: str, folder: Path) -> bool:
    """Return whether a distribution put ``name`` into a folder, which may hold other code too."""
    records = (path.read_text(encoding="utf-8") for path in folder.glob("*.dist-info/RECORD"))
    files = (f"{name}/", f"{name}.")
    return folder.name in _INSTALLED or any(
        line.startswith(files) for record in records for line in record.splitlines()
    )
