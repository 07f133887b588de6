"""The shape of a subtree: all that the covariance of its mean curves depends on.

The symbols are those of docs/mathematics/inference.md, section 2, "Trees of replicates".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.basics.arrays import Array

__all__ = ["Shape", "shape_above"]


@dataclass(frozen=True, eq=False)
class Shape:
    """The covariance structure of the P mean curves that a subtree is reduced to.

    Subtrees of one shape differ only in their draws and noise.

    Parameters
    ----------
    number : int
        Its place among the shapes of its level.
    units : mapping of str to ndarray of shape (P, I)
        C, for each layer the loadings of the mean curves on the draws in the subtree.
    observed : ndarray of bool, shape (P, D, N)
        Which entries of the mean curves are visible.
    noise : ndarray of shape (P,)
        ν, the factors of their noise variances.
    """

    number: int
    units: Mapping[str, Array]
    observed: NDArray[np.bool_]
    noise: Array

    def block(self, times: Array, data: Array, multiplicity: int) -> Block:
        """Return the problem of data vectors (h, P, D, N)."""
        noise = np.broadcast_to(self.noise[:, None, None], self.observed.shape)
        return Block(times, self.units, self.observed, data, noise, multiplicity).trim()

    def of_mean(self, size: int) -> Shape:
        """Return the shape of the mean of ``size`` subtrees: R^(−1/2) C and ν / R."""
        units = {layer: factor * size**-0.5 for layer, factor in self.units.items()}
        return replace(self, units=units, noise=self.noise / size)


def shape_above(layer: str, parts: Sequence[Shape], number: int) -> Shape:
    """Return the shape of a node, with a draw of ``layer``, above parts of these shapes."""
    # Draws below the node are those of one part each; the node's draw is in every curve.
    below = {name: block_diag(*(part.units[name] for part in parts)) for name in parts[0].units}
    noise = np.concatenate([part.noise for part in parts])
    return Shape(
        number,
        {layer: np.ones((len(noise), 1)), **below},
        np.concatenate([part.observed for part in parts]),
        noise,
    )
