"""Deviations of siblings from their mean, gathered into blocks."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.reduction.shapes import Shape
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.basics.arrays import Array

__all__ = ["Deviations"]


class Deviations:
    """Deviations of siblings from their mean, by the shape and the number of the siblings.

    Families with the same shape and number are data vectors of one block: the covariance Π between
    the data vectors is a projection with a constant diagonal, 1 − 1 / R for families of R siblings
    (docs/mathematics/inference.md, section 2, "Trees of replicates").
    """

    def __init__(self) -> None:
        self.families: dict[tuple[Shape, int], list[Array]] = {}

    def add(self, shape: Shape, data: Array) -> tuple[int, int]:
        """Add the deviations (R, P, D, N) of a family.

        Returns
        -------
        block, column : int
            The index of the block that they are in, and that of the first sibling's data vector.
            Blocks are counted from 1, since block 0 holds the means at the root.
        """
        key = (shape, len(data))
        families = self.families.setdefault(key, [])
        families.append(data)
        return 1 + [*self.families].index(key), len(data) * (len(families) - 1)

    def blocks(self, times: Array) -> list[Block]:
        """Return the block of each shape and number."""
        return [
            shape.block(times, np.concatenate(families), len(families) * (size - 1))
            for (shape, size), families in self.families.items()
        ]

    @property
    def log_jacobian(self) -> float:
        """The log-Jacobian of taking means: −½ n log R for each family of R siblings."""
        return -0.5 * sum(
            float(len(families) * shape.observed.sum() * np.log(size))
            for (shape, size), families in self.families.items()
        )
