"""Named arrays in files that a program reads without packages: .npz, .mat, or a folder of .csv."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import scipy.io
from numpy.typing import NDArray

from mocapbench.basics.array_archives import open_arrays

__all__ = ["EXCHANGES", "Exchange", "NamedArrays"]

NamedArrays = Mapping[str, NDArray[Any]]


class Exchange(ABC):
    """A way to write named arrays and to read them."""

    suffix: str
    """How the name of a file ends; that of a folder has no end."""
    advice: str
    """How a program writes what can be read."""

    @abstractmethod
    def write(self, path: Path, arrays: NamedArrays) -> None:
        """Write arrays of numbers or texts to a path that is new."""

    @abstractmethod
    def read(self, path: Path) -> NamedArrays:
        """Return arrays of numbers; raise whatever a library does where the content is another."""


class _NumPy(Exchange):
    suffix = ".npz"
    advice = "write it by numpy.savez(path, mean=mean)"

    def write(self, path: Path, arrays: NamedArrays) -> None:
        np.savez(path, allow_pickle=False, **arrays)

    def read(self, path: Path) -> NamedArrays:
        with open_arrays(path) as held:
            return {name: held[name] for name in held}


class _MatLab(Exchange):
    """Files of MATLAB's versions 5 to 7, in which texts are cells."""

    suffix = ".mat"
    advice = "write it by save(path, 'mean', '-v7')"

    def write(self, path: Path, arrays: NamedArrays) -> None:
        cells = {name: a.astype(object) if a.dtype.kind == "U" else a for name, a in arrays.items()}
        scipy.io.savemat(path, cells, oned_as="column")

    def read(self, path: Path) -> NamedArrays:
        return {name: np.asarray(value) for name, value in scipy.io.loadmat(path).items()}


class _Tables(Exchange):
    suffix = ""
    advice = "make a folder with mean.csv in it: commas, no header and no row names"

    def write(self, path: Path, arrays: NamedArrays) -> None:
        path.mkdir()
        for name, array in arrays.items():
            table = pd.DataFrame(np.atleast_1d(array))
            table.to_csv(path / f"{name}.csv", header=False, index=False, na_rep="NaN")

    def read(self, path: Path) -> NamedArrays:
        tables = {each.stem: pd.read_csv(each, header=None) for each in path.glob("*.csv")}
        return {name: table.to_numpy(dtype=float) for name, table in tables.items()}


EXCHANGES: Mapping[str, Exchange] = {"npz": _NumPy(), "mat": _MatLab(), "csv": _Tables()}
"""The ways by name: for Python, for MATLAB and Octave, and for any language."""
