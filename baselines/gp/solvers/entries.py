"""The visible entries of a block, output by output.

A *row* is a unit and a time at which some output is visible. Given the latent functions the outputs
are independent, so there is one matrix for each output, over all rows, with zeros where the output
is hidden: formulae then need no masks (docs/mathematics/solvers.md, section 5). Only
what is factorised is first reduced to the rows at which the output is visible.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array, Index

__all__ = ["Entries", "pick_entries", "place_entries"]


CHUNK = 2**18
"""Largest number of entries in the matrices of one chunk of outputs: two megabytes."""


@dataclass(frozen=True, eq=False)
class Entries:
    """The m rows of a block, and at which of them each output is visible.

    Parameters
    ----------
    unit, time : ndarray of int, shape (m,)
        The rows, by unit and then by time.
    spans : tuple of slice
        The rows of each unit.
    positions : tuple of ndarray of int, each of shape (n_d,)
        The rows at which each output is visible.
    visible : ndarray of bool, shape (D, m)
        The same as a mask.
    n_times : int
        The number N of times.
    """

    unit: Index
    time: Index
    spans: tuple[slice, ...]
    positions: tuple[Index, ...]
    visible: NDArray[np.bool_]
    n_times: int

    @classmethod
    def of(cls, observed: NDArray[np.bool_]) -> Entries:
        """List the entries that are True in ``observed`` (P, D, N)."""
        unit, time = np.nonzero(observed.any(axis=1))
        ends = np.cumsum(np.bincount(unit, minlength=len(observed))).tolist()
        spans = tuple(slice(start, end) for start, end in zip([0, *ends], ends, strict=False))
        visible = observed[unit, :, time].T
        positions = tuple(np.flatnonzero(seen) for seen in visible)
        return cls(unit, time, spans, positions, visible, observed.shape[2])

    @property
    def shape(self) -> tuple[int, int, int]:
        """(D, m, m), that of one matrix for each output."""
        return (*self.visible.shape, self.visible.shape[1])

    @property
    def chunks(self) -> tuple[slice, ...]:
        """Runs of consecutive outputs whose matrices together fit into a processor's cache."""
        n_outputs, n_rows = self.visible.shape
        size = max(1, CHUNK // max(n_rows, 1) ** 2)
        return tuple(slice(d, min(d + size, n_outputs)) for d in range(0, n_outputs, size))

    def gather_rows(self, values: Array) -> Array:
        """Return (D, m, h), the ``values`` (h, P, D, N) at the rows."""
        return np.ascontiguousarray(values[:, self.unit, :, self.time].transpose(2, 0, 1))

    def fold(self, loadings: Array, values: Array) -> Array:
        """Return (N, …), the sum over units p of loadings[p] times ``values`` (m, …) at p."""
        folded = np.zeros((self.n_times, *values.shape[1:]))
        for p in np.flatnonzero(loadings):
            folded[self.time[self.spans[p]]] += loadings[p] * values[self.spans[p]]
        return folded

    def unfold(self, loadings: Array, curves: Array) -> Array:
        """Return (m, …), at a row of unit p loadings[p] times ``curves`` (N, …).

        This is the adjoint of `fold`.
        """
        scale = loadings[self.unit].reshape(-1, *(1,) * (curves.ndim - 1))
        return np.asarray(scale * curves[self.time])

    def add_unfolded(self, rows: Array, columns: Array, block: Array, total: Array) -> None:
        """Add ``block`` (N, N), unfolded by ``rows`` and ``columns`` (P,), to ``total`` (m, m)."""
        for p in np.flatnonzero(rows):
            part = rows[p] * block[self.time[self.spans[p]]]
            for q in np.flatnonzero(columns):
                span = self.spans[q]
                total[self.spans[p], span] += columns[q] * part[:, self.time[span]]


def pick_entries(matrix: Array, positions: Index) -> Array:
    """Return rows and columns of ``matrix`` (m, m) at some positions, (n_d, n_d), C-ordered.

    Where all are picked it is the matrix itself: nothing is copied.
    """
    if len(positions) == len(matrix):
        return matrix
    return np.ascontiguousarray(matrix[positions][:, positions])


def place_entries(part: Array, positions: Index, matrix: Array) -> None:
    """Write ``part`` (n_d, n_d) into ``matrix`` (m, m), and zeros everywhere else."""
    if len(positions) == len(matrix):
        matrix[...] = part
        return
    rows = np.zeros((len(part), len(matrix)))
    rows[:, positions] = part
    matrix[...] = 0.0
    matrix[positions] = rows
