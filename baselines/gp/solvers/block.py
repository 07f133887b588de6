r"""The inference problem that every exact solver solves (docs/mathematics/inference.md, section 3).

A *unit* is a curve with all outputs: a replicate, or a mean of replicates. Units
:math:`p = 1 \dots P` are observed at times :math:`t` and outputs :math:`d`, with covariance

.. math:: K = \sum_\tau U_\tau \otimes \Big(\sum_q B_{\tau q} \otimes k_{\tau q}\Big)
          + \operatorname{diag}(\beta_d s_{pdt}), \qquad U_\tau = C_\tau C_\tau^\top,

over the layers :math:`\tau`. The h data vectors of a block are jointly
:math:`\mathcal N(0, \Pi \otimes K)`, where :math:`\Pi` is a projection of rank :math:`\rho` with a
constant diagonal :math:`\rho / h`: the identity for independent draws, the centring matrix for
deviations from a mean. The data lie in the range of :math:`\Pi`, and their log-density there is

.. math:: -\tfrac12 \Big[ \rho\,(\log|K| + n \log 2\pi) + \sum_{r=1}^h z_r^\top K^{-1} z_r \Big].
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.solvers.entries import Entries
from mocapbench.basics.arrays import Array

__all__ = ["Block", "Target"]


@dataclass(frozen=True, eq=False)
class Block:
    """One zero-mean Gaussian with layers, units, outputs and times.

    Parameters
    ----------
    times : ndarray of shape (N,)
        Times of observation.
    units : mapping of str to ndarray of shape (P, I)
        For each layer that takes part, the factor C of its Gram matrix U = C Cᵀ over units:
        unit p is Σ_i C[p, i] times the i-th independent draw of the layer.
    observed : ndarray of bool, shape (P, D, N)
        Which entries are visible.
    data : ndarray of shape (h, P, D, N)
        The data vectors, 0 where hidden.
    noise_scale : ndarray of shape (P, D, N)
        Factor s of the noise variance β_d.
    multiplicity : int
        ρ, the rank of the covariance Π between the h data vectors.
    """

    times: Array
    units: Mapping[str, Array]
    observed: NDArray[np.bool_]
    data: Array
    noise_scale: Array
    multiplicity: int

    @cached_property
    def lags(self) -> Array:
        """(N, N) differences of the times."""
        return np.subtract.outer(self.times, self.times)

    @cached_property
    def grams(self) -> Mapping[str, Array]:
        """(P, P) Gram matrix U of each layer."""
        return {name: factor @ factor.T for name, factor in self.units.items()}

    @cached_property
    def positions(self) -> tuple[NDArray[np.intp], ...]:
        """For each unit the visible entries, as indices into its flat (D, N) grid."""
        return tuple(np.flatnonzero(unit) for unit in self.observed)

    @cached_property
    def entries(self) -> Entries:
        """The visible entries, output by output."""
        return Entries.of(self.observed)

    @property
    def n_visible(self) -> int:
        """The length n of a data vector."""
        return int(self.observed.sum())

    @property
    def variance_scale(self) -> float:
        """ρ / h, the constant diagonal of Π: each data vector has covariance (ρ / h) K."""
        return self.multiplicity / len(self.data)

    def trim(self) -> Block:
        """Return the same problem without the times at which nothing is visible."""
        keep = self.observed.any(axis=(0, 1))
        return Block(
            self.times[keep],
            self.units,
            self.observed[:, :, keep],
            self.data[..., keep],
            self.noise_scale[:, :, keep],
            self.multiplicity,
        )


@dataclass(frozen=True, eq=False)
class Target:
    """A function of time to be inferred from a data vector of a block.

    In each layer it is Σ_i a_i times the i-th independent draw of that layer, plus a draw that is
    independent of the block's data, scaled to the variance ``independent_variance``.

    Parameters
    ----------
    weights : mapping of str to ndarray of shape (I,)
        The coefficients a, for each layer of the block.
    independent_variance : mapping of str to float, default={}
        Variance of the independent draw, relative to the layer's. Layers left out have none.
    block, column : int, default=0
        The indices of the block among several, and of the data vector.
    """

    weights: Mapping[str, Array]
    independent_variance: Mapping[str, float] = field(default_factory=dict)
    block: int = 0
    column: int = 0

    def prior_scale(self, layer: str) -> float:
        """Return aᵀa + φ, the target's prior variance relative to the layer's.

        φ is the layer's ``independent_variance``.
        """
        weights = self.weights[layer]
        return float(weights @ weights) + self.independent_variance.get(layer, 0.0)
