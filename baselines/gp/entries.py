"""The visible entries of a block, output by output, and its grid of pairs of entries.

Given the latent functions the outputs are independent, so that matrices over the entries come in
two forms: one for each output over its n_d visible entries, which is factorised, and *grids*
(P, P, D, N, N) over all pairs of units and times, which meet the kernels. Output by output the
matrices are small enough to stay in the processor's cache.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

__all__ = ["Entries"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Entries:
    """The visible entries of every output.

    Parameters
    ----------
    shape : tuple of int
        P, D and N.
    positions : tuple of ndarray of int, shape (n_d,)
        For each output its visible entries, as indices into its flat (P, N) grid.
    """

    shape: tuple[int, int, int]
    positions: tuple[NDArray[np.intp], ...]

    @classmethod
    def of(cls, observed: NDArray[np.bool_]) -> Entries:
        """List the entries that are True in ``observed`` (P, D, N)."""
        n_units, n_outputs, n_times = observed.shape
        by_output = observed.transpose(1, 0, 2).reshape(n_outputs, n_units * n_times)
        positions = tuple(np.flatnonzero(seen) for seen in by_output)
        return cls((n_units, n_outputs, n_times), positions)

    @cached_property
    def pairs(self) -> tuple[NDArray[np.intp], ...]:
        """For each output its pairs of entries (n_d, n_d), as indices into a flat grid."""
        n_units, n_outputs, n_times = self.shape
        size = n_outputs * n_times**2
        unit_and_time = [np.divmod(positions, n_times) for positions in self.positions]
        return tuple(
            np.add.outer(unit * n_units * size + time * n_times, unit * size + time)
            + d * n_times**2
            for d, (unit, time) in enumerate(unit_and_time)
        )

    def zeros(self) -> Array:
        """Return a grid (P, P, D, N, N) of zeros."""
        n_units, n_outputs, n_times = self.shape
        return np.zeros((n_units, n_units, n_outputs, n_times, n_times))

    def pick(self, values: Array) -> list[Array]:
        """Return for each output the entries (n_d, h) of ``values`` (P, D, N, h)."""
        by_output = values.transpose(1, 0, 2, 3).reshape(self.shape[1], -1, values.shape[3])
        return [rows[own] for rows, own in zip(by_output, self.positions, strict=True)]

    def place(self, values: Iterable[Array], width: int) -> Array:
        """Return (P, D, N, ``width``), the ``values`` (n_d, width) of each output, else 0."""
        n_units, n_outputs, n_times = self.shape
        by_output = np.zeros((n_outputs, n_units * n_times, width))
        for rows, own, one in zip(by_output, self.positions, values, strict=True):
            rows[own] = one
        return by_output.reshape(n_outputs, n_units, n_times, width).transpose(1, 0, 2, 3)
