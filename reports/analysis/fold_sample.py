"""The values of a label, one a fold, and what each weighs in their mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from mocapbench.reports.analysis.units import unit_weights

__all__ = ["FoldSample"]


@dataclass(frozen=True, eq=False)
class FoldSample:
    """Values with the weights of `mocapbench.reports.analysis.units`.

    Parameters
    ----------
    values : tuple of float
        One a fold, n in all, each finite.
    weights : sparse array of shape (n_units, n)
        Of the folds, each in the row of its unit. Their sum is 1.
    """

    values: tuple[float, ...]
    weights: csr_array[np.float64]

    @classmethod
    def of(cls, values: Sequence[float], units: Sequence[str], cases: Sequence[str]) -> Self:
        """Return the sample of values whose units and cases are given."""
        return cls(tuple(values), unit_weights(units, cases))

    @property
    def n_units(self) -> int:
        """How many independent units there are."""
        return int(self.weights.shape[0])
