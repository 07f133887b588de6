"""The predictions of a run directory, one file of arrays per fit."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mocapbench.basics.whole_files import atomic_write
from mocapbench.benchmark.runs.directory.files_by_key import FilesByKey
from mocapbench.benchmark.runs.fitting.fit import Fit

__all__ = ["PREDICTIONS", "FitFiles"]

T = TypeVar("T")

PREDICTIONS = "predictions"
_UNREADABLE = (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile)
"""What reading damaged predictions raises."""


class FitFiles:
    """The predictions of a run directory, with what each fit cost.

    Parameters
    ----------
    run : Path
        The run directory.
    damaged : list of str
        To which a message is added for every file that is truncated or foreign.
    """

    def __init__(self, run: Path, damaged: list[str]) -> None:
        self.files = FilesByKey(run / PREDICTIONS, ".npz")
        self._damaged = damaged

    def load(self, key: str) -> Fit | None:
        """Return the fit called ``key``, or None if it is absent or damaged."""
        return self._read(key, _whole)

    def has(self, key: str) -> bool:
        """Return whether there are predictions called ``key``, as far as a glance can tell."""
        return self._read(key, _about) is not None

    def _read(self, key: str, read: Callable[[Any, str], T]) -> T | None:
        path = self.files.find(key)
        if not path.is_file():
            return None
        try:
            with np.load(path, allow_pickle=False) as arrays:
                return read(arrays, key)
        except _UNREADABLE as error:
            self._damaged.append(f"{path}: not a whole set of predictions: {error}")
            return None

    def save(self, key: str, fit: Fit) -> None:
        """Write ``fit`` whole or not at all.

        It is not compressed: of such numbers that would save a quarter of the bytes, and take
        longer than all else that a run does itself with a job.
        """
        about = {**fit.costs, "key": key}
        with atomic_write(self.files.make_room(key)) as file:
            arrays: dict[str, Any] = {**fit.arrays, "about": np.array(json.dumps(about))}
            np.savez(file, **arrays)


def _about(arrays: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Return what predictions say of themselves, which must be those called ``key``."""
    about: dict[str, Any] = json.loads(str(arrays["about"]))
    if about.pop("key") != key:
        raise ValueError("it holds those of another job")
    return about


def _whole(arrays: Mapping[str, Any], key: str) -> Fit:
    about = _about(arrays, key)
    contents = {name: array for name, array in arrays.items() if name != "about"}
    return Fit(contents, **{**about, "warnings": tuple(about["warnings"])})
