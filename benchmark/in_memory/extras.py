"""Libraries that only some uses in memory need."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

__all__ = ["require_extra"]

EXTRA = "notebook"


def require_extra(name: str, use: str, extra: str = EXTRA) -> ModuleType:
    """Return a module that an extra brings.

    Parameters
    ----------
    name : str
        Such as ``"matplotlib.pyplot"``.
    use : str
        What needs it.
    extra : str, default="notebook"

    Raises
    ------
    ImportError
        If its package is not installed; the message says how to install it.
    """
    try:
        return import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise ImportError(
            f"{use} needs {package}, which cannot be imported: pip install 'mocapbench[{extra}]'"
        ) from error
