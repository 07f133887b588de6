"""The problem of filling hidden entries."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays, arrays_by_number, with_numbers
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem
from mocapbench.benchmark.problems.body import Body
from mocapbench.benchmark.problems.placement import imputed_poses
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.datasets import FrameByChannel, Mask, Recording
from mocapbench.metrics import Imputation, ImputedPoses
from mocapbench.metrics.entries import mean_over, variance_over

if TYPE_CHECKING:
    from mocapbench.baselines import FrameImputer, Prediction

__all__ = ["ImputeProblem", "Predictions"]

Predictions = tuple["Prediction", ...]
"""One for each recording to fill, in order; all have a variance, or none has."""


@dataclass(frozen=True, eq=False)
class ImputeProblem(Problem[Predictions]):
    """Fill the hidden entries of some recordings.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    given : tuple of Recording
        The recordings to fill; NaN marks what is hidden.
    truth : tuple of ndarray (N, D)
        Their values, which no model sees. An entry that is NaN here too is known to nobody: it is
        filled and not scored.
    unit : Unit
        The unit that scores are taken in.
    body : Body or None
        Places the joints in space, for metrics in centimetres and for figures.
    scales : ndarray of shape (D,) or None
        See `mocapbench.metrics.Imputation`.
    process : ToyProcess or None
        The process that generated them, for models that need it.
    parent : Recording or None
        The curves of the parent that a known process drew, which no model sees.
    """

    given: tuple[Recording, ...]
    truth: tuple[FrameByChannel, ...]
    unit: Unit
    body: Body | None = None
    scales: NDArray[np.float64] | None = None

    @classmethod
    def of_one(
        cls,
        recording: Recording,
        hidden: Mask,
        others: Sequence[Recording] = (),
        *,
        seen_in_fit: bool = True,
        body: Body | None = None,
    ) -> Self:
        """Return the problem of filling one recording, scored in its channels' own units.

        Parameters
        ----------
        recording : Recording
            Its own missing entries are filled too, and not scored.
        hidden : ndarray of bool, shape (N, D)
            True where its entries are hidden.
        others : sequence of Recording
            What models learn from besides.
        seen_in_fit : bool
            Whether models learn from the recording's visible entries too; if not, the task must
            require "fills new recordings".
        body : Body or None
            Places the joints in space.
        """
        given = recording.hide(hidden)
        own = (given,) if seen_in_fit else ()
        unit = Unit.natural(len(recording.channels))
        return cls((*others, *own), (given,), (recording.values,), unit, body)

    def solve(self, model: FrameImputer, random_state: int) -> Predictions:
        """Return the model's predictions of the recordings given."""
        del random_state  # imputation draws nothing
        return self.check_predictions(model.impute(self.given), "impute")

    def check_predictions(self, predictions: object, method: str) -> Predictions:
        """Return what a method of a model returned, checked.

        Raises
        ------
        InvalidPredictionError
            If it is no list of predictions that fit the recordings given.
        """
        # Imported where it is used: who lists tasks solves none, and models take long to import.
        from mocapbench.baselines import Prediction  # noqa: PLC0415

        wanted = [Prediction] * len(self.given)
        if not isinstance(predictions, list) or list(map(type, predictions)) != wanted:
            raise InvalidPredictionError(
                f"{method}: expected a list of {len(wanted)} Prediction, got {predictions!r:.200}"
            )
        solution = tuple(map(_check_prediction, self.given, predictions))
        if len({prediction.variance is None for prediction in predictions}) > 1:
            raise InvalidPredictionError(
                f"{method}: expected a variance with every Prediction or with none, got both"
            )
        return solution

    def outcome(self, solution: Predictions) -> Imputation:
        """Put the recordings one below the other, in the problem's unit."""
        visible_mean, visible_variance = self._visible_moments()
        truth, mean = np.concatenate(self.truth), np.concatenate([p.mean for p in solution])
        variances, known = _list_variances(solution), np.isfinite(truth)
        return Imputation(
            truth=self.unit.of(np.where(known, truth, mean)),
            mean=self.unit.of(mean),
            variance=np.concatenate(variances) / self.unit.scale**2 if variances else None,
            hidden=known & ~np.concatenate([recording.visible for recording in self.given]),
            visible_mean=visible_mean,
            visible_variance=visible_variance,
            scales=self.scales,
            units=self.unit.names(self.given[0].units),
            place_joints=self._placement(solution),
        )

    def to_arrays(self, solution: Predictions) -> Arrays:
        """Return ``mean-i`` and, where there is one, ``variance-i`` of recording i."""
        means = (prediction.mean for prediction in solution)
        variances = _list_variances(solution)
        return {**with_numbers("mean", means), **with_numbers("variance", variances)}

    def from_arrays(self, arrays: Arrays) -> Predictions:
        """Return the solution that `to_arrays` turned into ``arrays``."""
        from mocapbench.baselines import Prediction  # noqa: PLC0415

        means, variances = arrays_by_number("mean", arrays), arrays_by_number("variance", arrays)
        return tuple(map(Prediction, means, variances or (None,) * len(means)))

    def _placement(self, solution: Predictions) -> Callable[[], ImputedPoses] | None:
        if self.body is None:
            return None
        return partial(imputed_poses, self.body, self.given, self.truth, solution)

    def _visible_moments(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return moments over all recordings given to fit and impute, each counted once."""
        unique = {recording.name: recording for recording in (*self.train, *self.given)}
        values = self.unit.of(np.concatenate([recording.values for recording in unique.values()]))
        seen = np.isfinite(values)
        moments = mean_over(values, seen, axis=0), variance_over(values, seen)
        return np.nan_to_num(moments[0]), np.nan_to_num(moments[1])


def _list_variances(solution: Predictions) -> list[FrameByChannel]:
    return [prediction.variance for prediction in solution if prediction.variance is not None]


def _check_prediction(recording: Recording, prediction: Prediction) -> Prediction:
    """Return the prediction as float64, once it is known to be usable."""
    hidden = ~recording.visible
    mean = _usable("mean", prediction.mean, hidden, recording.name)
    if prediction.variance is None:
        return replace(prediction, mean=mean)
    variance = _usable("variance", prediction.variance, hidden, recording.name)
    if not (variance[hidden] > 0).all():
        raise InvalidPredictionError(
            f"{recording.name}: expected a positive variance at hidden entries, "
            f"got {float(variance[hidden].min()):g}"
        )
    return replace(prediction, mean=mean, variance=variance)


def _usable(what: str, values: FrameByChannel, hidden: Mask, name: str) -> FrameByChannel:
    array = np.asarray(values, dtype=np.float64)
    if array.shape != hidden.shape:
        raise InvalidPredictionError(
            f"{name}: expected a {what} of shape {hidden.shape}, got {array.shape}"
        )
    bad = int((~np.isfinite(array[hidden])).sum())
    if bad:
        raise InvalidPredictionError(
            f"{name}: expected a finite {what} at all {int(hidden.sum())} hidden entries, "
            f"got {bad} that are NaN or infinite"
        )
    return array
