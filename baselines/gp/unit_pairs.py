"""A block's latent functions by pairs of units.

A unit sees its own draws of the child and the one draw of the parent. Where a sum over pairs of
latent functions meets a grid over pairs of units, the pairs that a block of the grid does not see
are left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.latents import Latents

__all__ = ["UnitPair", "unit_pairs"]

Array = NDArray[np.float64]


class UnitPair(NamedTuple):
    """Two units with the latent functions that each sees.

    Parameters
    ----------
    units : tuple of int
        p and q.
    members : tuple of ndarray of int, shapes (I,) and (J,)
        The latent functions that p and q see.
    loadings : tuple of ndarray, shapes (I, D) and (J, D)
        w_i c_ip and w_j c_jq, how their outputs load on them.
    """

    units: tuple[int, int]
    members: tuple[NDArray[np.intp], NDArray[np.intp]]
    loadings: tuple[Array, Array]

    @property
    def blocks(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Index of the pairs of latent functions in an array (n, n, ...)."""
        return self.members[0][:, None], self.members[1][None]

    @property
    def products(self) -> Array:
        """(I, J, D) products of the loadings."""
        left, right = self.loadings
        return left[:, None] * right[None]


def unit_pairs(latents: Latents) -> Iterator[UnitPair]:
    """Yield every pair of units."""
    members = [np.flatnonzero(unit) for unit in latents.units.T]
    loadings = [latents.loadings[p][:, own].T for p, own in enumerate(members)]
    for p, q in np.ndindex(len(members), len(members)):
        yield UnitPair((p, q), (members[p], members[q]), (loadings[p], loadings[q]))
