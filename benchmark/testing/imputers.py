"""Checks of imputers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.benchmark.testing.errors import ConformanceError, require, require_equal
from mocapbench.benchmark.testing.subject import COMPLETE, END, GAP, SCATTERED, Subject, problem
from mocapbench.datasets import Recording

__all__ = [
    "continues_recordings",
    "fills_any_mask",
    "fills_channels_apart",
    "fills_new_recordings",
    "fills_whole_frames",
    "ignores_the_names_of_recordings",
    "ignores_the_order_of_recordings",
    "keeps_means_in_calibration",
    "refuses_new_recordings",
    "repeats_itself",
]

_TOLERANCE = 1e-4
_ROUNDING = 1e-6
"""What the order and the names of recordings may change, in standard deviations."""


def continues_recordings(subject: Subject) -> None:
    """Check that the frames after the last visible one are filled, the same from the same seed."""
    _require_repetition(subject, problem(END))


def fills_whole_frames(subject: Subject) -> None:
    """Check that frames that are hidden as a whole are filled."""
    recordings = problem(GAP)
    _fill_recordings(subject.fit_model(recordings), [recordings[-1]])


def fills_any_mask(subject: Subject) -> None:
    """Check that hidden entries are filled wherever they are."""
    recordings = problem(SCATTERED)
    _fill_recordings(subject.fit_model(recordings), list(recordings))


def fills_channels_apart(subject: Subject) -> None:
    """Check that a channel is filled from its own entries in the same recording alone."""
    *_, last = problem(SCATTERED)
    together = _fill_recordings(subject.fit_model(problem(SCATTERED)), [last])[0].mean
    for d, channel in enumerate(last.channels):
        alone = last.select([channel])
        mean = _fill_recordings(subject.fit_model([alone]), [alone])[0].mean
        expected = "each channel filled as if it were alone"
        advice = "use its entries in this recording, or do not inherit Interpolator"
        require_equal(mean, together[:, [d]], expected, advice)


def repeats_itself(subject: Subject) -> None:
    """Check that the same seed gives the same answer."""
    _require_repetition(subject, problem(GAP))


def _require_repetition(subject: Subject, recordings: Sequence[Recording]) -> None:
    """Require that two fits with the same seed fill the last recording alike."""
    one, two = (
        _fill_recordings(subject.fit_model(recordings), [recordings[-1]])[0].mean for _ in range(2)
    )
    advice = "take all randomness from random_state"
    require_equal(one, two, "the same answer from the same seed", advice)


def keeps_means_in_calibration(subject: Subject) -> None:
    """Check that the means before calibration are those after."""
    recordings = problem(GAP)
    filled, nominal = (
        _fill_recordings(subject.fit_model(recordings), [recordings[-1]], method)[0]
        for method in ("impute", "impute_uncalibrated")
    )
    advice = "let impute_uncalibrated change variances alone, or do not define it"
    gap = float(np.abs(nominal.mean - filled.mean).max())
    require(
        np.allclose(nominal.mean, filled.mean, rtol=_TOLERANCE, atol=_TOLERANCE),
        "impute_uncalibrated to have the means of impute",
        f"a difference of {gap:.2g}",
        advice,
    )
    both = [answer.variance is not None for answer in (filled, nominal)]
    expected = "variances of both impute and impute_uncalibrated, or of neither"
    require(both[0] == both[1], expected, f"{both[0]} and {both[1]}", advice)


def ignores_the_order_of_recordings(subject: Subject) -> None:
    """Check that the order of the other recordings means nothing."""
    *others, last = problem(GAP)
    _compare_training(subject, [*others, last], [*reversed(others), last], "in another order")


def ignores_the_names_of_recordings(subject: Subject) -> None:
    """Check that the names of the other recordings mean nothing."""
    *others, last = problem(GAP)
    renamed = [replace(one, name=f"z{9 - number}") for number, one in enumerate(others)]
    _compare_training(subject, [*others, last], [*renamed, last], "with other names")


def _compare_training(
    subject: Subject, one: Sequence[Recording], other: Sequence[Recording], how: str
) -> None:
    """Compare what is filled of the last recording after learning from it and the others."""
    first, second = (
        _fill_recordings(subject.fit_model(train), [train[-1]])[0].mean for train in (one, other)
    )
    scale = float(np.nanstd(one[-1].values))
    gap = float(np.abs(first - second).max()) / scale
    require(
        gap <= _ROUNDING,
        f"the same answer for training recordings {how}",
        f"a difference of {gap:.2g} of a standard deviation",
        "learn from them in an order that follows from their values, or let all count alike",
    )


def fills_new_recordings(subject: Subject) -> None:
    """Check that a recording that fit has not seen is filled: the class is `Inductive`."""
    seen = COMPLETE[-1]
    new = Recording("new", seen.times, seen.values, seen.channels, seen.units).hide(END)
    _fill_recordings(subject.fit_model(COMPLETE[:-1]), [new])


def refuses_new_recordings(subject: Subject) -> None:
    """Check that a recording that fit has not seen is refused by name: it is not `Inductive`."""
    new = COMPLETE[-1].hide(END)
    model = subject.fit_model(COMPLETE[:-1])
    expected = f"a ValueError that names {new.name}, which fit has not seen"
    advice = "raise it, or inherit Inductive if you can fill new recordings"
    try:
        answer = model.impute([new])
    except ValueError as error:
        require(new.name in str(error), expected, f"{error!r}", advice)
    else:
        raise ConformanceError(f"expected {expected}, got {type(answer).__name__}: {advice}")


def _fill_recordings(
    model: Any, recordings: list[Recording], method: str = "impute"
) -> list[Prediction]:
    predictions = getattr(model, method)(recordings)
    kinds = [type(prediction).__name__ for prediction in predictions]
    require(
        kinds == [Prediction.__name__] * len(recordings),
        f"{method} to return a list of {len(recordings)} Prediction",
        kinds,
        "return one Prediction per recording, in order",
    )
    for recording, prediction in zip(recordings, predictions, strict=True):
        _check_mean(recording, prediction.mean)
        if prediction.variance is not None:
            _check_variance(recording, prediction.variance)
    return list(predictions)


def _check_mean(recording: Recording, mean: Any) -> None:
    shape, advice = recording.values.shape, "Prediction.around(recording, mean) does it"
    require(np.shape(mean) == shape, f"a mean of shape {shape}", np.shape(mean), advice)
    bad = int((~np.isfinite(mean)).sum())
    require(bad == 0, "a finite mean", f"{bad} NaN or infinite entries", "fill every hidden entry")
    visible = recording.visible
    expected = "visible entries copied into the mean"
    require_equal(mean[visible], recording.values[visible], expected, advice)


def _check_variance(recording: Recording, variance: Any) -> None:
    shape, advice = recording.values.shape, "Prediction.around(recording, mean, variance) does it"
    require(np.shape(variance) == shape, f"a variance of shape {shape}", np.shape(variance), advice)
    least = float(np.min(variance[~recording.visible], initial=np.inf))
    none = "return no variance if the model has no predictive distribution"
    require(least > 0, "a positive variance at hidden entries", f"{least:g}", none)
    visible = variance[recording.visible]
    require_equal(visible, np.zeros_like(visible), "no variance at visible entries", advice)
