"""The problem of filling hidden entries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import FrameImputer, Prediction
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem, Solution
from mocapbench.datasets import FrameByChannel, Recording, Skeleton
from mocapbench.metrics import Imputation

__all__ = ["ImputeProblem", "Unit"]


@dataclass(frozen=True, eq=False)
class Unit:
    """An affine unit of measurement per channel, in which scores are taken.

    Parameters
    ----------
    offset, scale : ndarray of shape (D,)
        A value y is scored as (y − offset) / scale.
    """

    offset: NDArray[np.float64]
    scale: NDArray[np.float64]

    @classmethod
    def natural(cls, n_channels: int) -> Unit:
        """Return the channels' own units."""
        return cls(np.zeros(n_channels), np.ones(n_channels))

    @classmethod
    def range_of(cls, values: FrameByChannel) -> Unit:
        """Return the min-max unit of complete ``values`` (N, D)."""
        low = values.min(axis=0)
        return cls(low, values.max(axis=0) - low)

    def of(self, values: FrameByChannel) -> FrameByChannel:
        """Return ``values`` (N, D) in this unit."""
        return (values - self.offset) / self.scale


@dataclass(frozen=True, eq=False)
class ImputeProblem(Problem):
    """Fill the hidden entries of some recordings.

    Parameters
    ----------
    given : tuple of Recording
        The recordings to fill; NaN marks what is hidden.
    truth : tuple of ndarray (N, D)
        Their complete values, which no model sees.
    unit : Unit
        The unit that scores are taken in.
    skeleton : Skeleton or None
        Whose degrees of freedom the channels are, for figures.
    """

    given: tuple[Recording, ...]
    truth: tuple[FrameByChannel, ...]
    unit: Unit
    skeleton: Skeleton | None = None

    def solve(self, model: FrameImputer, random_state: int) -> Solution:
        """Return ``mean-i`` and, where the model has one, ``variance-i`` for recording i."""
        del random_state  # imputation draws nothing
        predictions = model.impute(self.given)
        wanted = [Prediction] * len(self.given)
        if not isinstance(predictions, list) or list(map(type, predictions)) != wanted:
            raise InvalidPredictionError(
                f"impute: expected a list of {len(wanted)} Prediction, got {predictions!r:.200}"
            )
        solution: dict[str, NDArray[np.float64]] = {}
        for index, (recording, prediction) in enumerate(zip(self.given, predictions, strict=True)):
            for name, values in _checked(recording, prediction).items():
                solution[f"{name}-{index}"] = values
        return solution

    def outcome(self, solution: Solution) -> Imputation:
        """Concatenate the recordings along the frames, in the problem's unit."""
        indices = range(len(self.given))
        visible_mean, visible_variance = self._visible_moments()
        variance = None
        if "variance-0" in solution:
            variance = np.concatenate([solution[f"variance-{i}"] for i in indices])
            variance = variance / self.unit.scale**2
        return Imputation(
            truth=self.unit.of(np.concatenate(self.truth)),
            mean=self.unit.of(np.concatenate([solution[f"mean-{i}"] for i in indices])),
            variance=variance,
            hidden=~np.concatenate([recording.visible for recording in self.given]),
            visible_mean=visible_mean,
            visible_variance=visible_variance,
        )

    def _visible_moments(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Moments over all recordings given to fit and impute, each counted once."""
        unique = {recording.name: recording for recording in (*self.train, *self.given)}
        values = self.unit.of(np.concatenate([recording.values for recording in unique.values()]))
        seen = np.ma.masked_invalid(values)
        return seen.mean(axis=0).filled(0.0), seen.var(axis=0).filled(0.0)


def _checked(recording: Recording, prediction: Prediction) -> dict[str, NDArray[np.float64]]:
    """Return the prediction's arrays by name, once they are known to be usable."""
    hidden = ~recording.visible
    arrays = {"mean": prediction.mean, "variance": prediction.variance}
    answers = {
        name: np.asarray(values, dtype=np.float64)
        for name, values in arrays.items()
        if values is not None
    }
    for name, values in answers.items():
        if values.shape != hidden.shape:
            raise InvalidPredictionError(
                f"{recording.name}: expected a {name} of shape {hidden.shape}, got {values.shape}"
            )
        if not np.isfinite(values[hidden]).all():
            bad = int((~np.isfinite(values[hidden])).sum())
            raise InvalidPredictionError(
                f"{recording.name}: expected a finite {name} at all {int(hidden.sum())} hidden "
                f"entries, got {bad} that are NaN or infinite"
            )
    if "variance" in answers and not (answers["variance"][hidden] > 0).all():
        worst = float(answers["variance"][hidden].min())
        raise InvalidPredictionError(
            f"{recording.name}: expected a positive variance at hidden entries, got {worst:g}"
        )
    return answers
