"""The fit of mean and components to cycles, in rounds of filling and estimating again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.functional.basis import norms, roughness
from mocapbench.baselines.functional.components import (
    LEAST_NOISE,
    Components,
    Scores,
    infer_scores,
    penalised_likelihood,
    update,
)
from mocapbench.baselines.functional.statistics import CurveStatistics
from mocapbench.basics.arrays import Array

__all__ = ["ComponentFit", "fit_components", "start"]


@dataclass(frozen=True, eq=False)
class ComponentFit:
    """Components, and the scores of the cycles that they were fitted to.

    Parameters
    ----------
    components : Components
    scores : Scores
    """

    components: Components
    scores: Scores

    @classmethod
    def of(cls, statistics: CurveStatistics, components: Components) -> Self:
        """Infer the scores."""
        return cls(components, infer_scores(statistics, components))


def start(
    statistics: CurveStatistics, curve: Array, n_components: int, smoothness: float
) -> Components:
    """Return components from the singular value decomposition of each cycle's smooth deviations.

    Parameters
    ----------
    statistics : CurveStatistics
        Of J cycles.
    curve : ndarray of shape (D, P)
        The mean curve.
    n_components : int
        Q, at most J − 1.
    smoothness : float
        Weight of the roughness.
    """
    n_cycles, (n_channels, n_functions) = len(statistics.squares), curve.shape
    gradient = statistics.cross - (statistics.grams @ curve[..., None])[..., 0]
    # A deviation has prior variance 1: a cycle of few visible entries keeps close to the mean.
    ridge = np.diag(1.0 + smoothness * roughness((n_functions - 1) // 2))
    deviations = np.linalg.solve(statistics.grams + ridge, gradient[..., None])[..., 0]
    weights = np.tile(np.sqrt(norms((n_functions - 1) // 2)), n_channels)
    _, lengths, axes = np.linalg.svd(
        deviations.reshape(n_cycles, -1) * weights, full_matrices=False
    )
    scaled = lengths[:n_components, None] / np.sqrt(n_cycles) * axes[:n_components] / weights
    components = scaled.reshape(-1, n_channels, n_functions)
    errors = statistics.squares.sum(axis=0) - np.einsum(
        "dp,dp->d", curve, statistics.cross.sum(axis=0) + gradient.sum(axis=0)
    )
    noise = np.maximum(errors / np.maximum(statistics.counts.sum(axis=0), 1.0), LEAST_NOISE)
    return Components(np.concatenate([curve[None], components]), noise)


def fit_components(
    statistics: CurveStatistics,
    initial: Components,
    smoothness: float,
    *,
    max_iter: int,
    tol: float,
) -> Ascent[ComponentFit]:
    """Alternate scores and components until the likelihood has converged.

    Parameters
    ----------
    statistics : CurveStatistics
        Of J cycles.
    initial : Components
        Where to start.
    smoothness : float
        Weight of the roughness.
    max_iter : int
        Largest number of rounds.
    tol : float
        It has once a round raises it by less than this per visible entry.
    """
    return ascend(
        ComponentFit.of(statistics, initial),
        lambda now: ComponentFit.of(
            statistics, update(statistics, now.scores, now.components, smoothness)
        ),
        lambda now: penalised_likelihood(now.scores, now.components, smoothness),
        max_iter=max_iter,
        threshold=tol * statistics.counts.sum(),
    )
