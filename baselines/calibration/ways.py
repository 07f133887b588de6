r"""From errors where the truth is known to calibrated predictions, in the way that suits the model.

Means stay as they are; the variances of each channel are multiplied by a factor.

* A model that can leave visible entries out one by one (`leave_one_out`) takes the larger of two
  ratios: that of these entries, and that of held-out gaps of three frames or more.
* A model that learns in `fit` is checked by the held-out gaps of the recording (`variance_check`).
  Channels that are hidden throughout have no held-out gap: see `_calibrate_lost_channels`.
* A model that learns nothing in `fit` costs nothing to fit to fewer recordings. Let :math:`o_d` be
  the error ratio of channel d in the recording's own held-out gaps, :math:`t_d` that in held-out
  recordings, which have the gaps as they are, and g by how much the ratio there, over all channels,
  is larger in gaps than in copies of them that had to be shorter. Both :math:`g\, o_d` and
  :math:`t_d` say what variances have to be multiplied by. Which of them is right is not known, and
  the variance of an equal mixture of both is taken: the factor is :math:`(g\, o_d + t_d) / 2`,
  which may be less than 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any

import numpy as np
from sklearn.base import clone

from mocapbench.baselines.calibration.error_ratios import LEAST, mean_ratios, sum_ratios
from mocapbench.baselines.calibration.held_out_gaps import hold_out_channels, long_copies
from mocapbench.baselines.calibration.held_out_recordings import sum_ratios_elsewhere
from mocapbench.baselines.calibration.left_out_entries import leave_one_out_factors
from mocapbench.baselines.calibration.variance_check import VarianceCheck
from mocapbench.baselines.common.checks import pool
from mocapbench.baselines.protocols import FrameImputer, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["calibrate", "impute_held_out"]

_TINY = np.finfo(np.float64).tiny


def calibrate(
    model: FrameImputer, learnt_from: Sequence[Recording], recordings: Sequence[Recording]
) -> list[Prediction]:
    """Return the predictions of a fitted model with calibrated variances.

    Parameters
    ----------
    model : FrameImputer
        Its prediction of one recording may not depend on the others.
    learnt_from : sequence of Recording
        Those given to its ``fit``.
    recordings : sequence of Recording
        To be filled.
    """
    if hasattr(model, "leave_one_out"):
        return _calibrate_by_leave_one_out(model, recordings)
    nominal = model.impute(recordings)
    pairs = zip(recordings, nominal, strict=True)
    known = [(one, prediction) for one, prediction in pairs if prediction.variance is not None]
    calibrated = iter(_choose_way(model, learnt_from, known) if known else ())
    return [each if each.variance is None else next(calibrated) for each in nominal]


def _choose_way(
    model: FrameImputer,
    learnt_from: Sequence[Recording],
    known: Sequence[tuple[Recording, Prediction]],
) -> list[Prediction]:
    recordings, nominal = zip(*known, strict=True)
    if not model.learns_in_fit:
        return [
            _calibrate_by_held_out_recordings(model, learnt_from, recording, prediction)
            for recording, prediction in zip(recordings, nominal, strict=True)
        ]
    return _calibrate_by_held_out_gaps(model, learnt_from, recordings, nominal)


def _calibrate_by_leave_one_out(model: Any, recordings: Sequence[Recording]) -> list[Prediction]:
    """Multiply the variances of a channel by the larger of two mean ratios.

    It is less than 1 only as far as all entries together support. Single frames between visible
    ones say nothing of longer gaps, which are therefore held out besides.
    """
    calibrated = []
    left_out = model.leave_one_out(recordings)
    for recording, (prediction, ratios) in zip(recordings, left_out, strict=True):
        factors = leave_one_out_factors(recording.visible, ratios)
        check = VarianceCheck(recording, long_copies)
        if check.copies:
            held_out = model.impute_held_out(check.recordings())
            factors = np.maximum(factors, check.factors(held_out))
        calibrated.append(_multiply_variance(prediction, factors))
    return calibrated


def _multiply_variance(nominal: Prediction, factors: Array) -> Prediction:
    return Prediction(nominal.mean, np.asarray(nominal.variance) * factors)


def _calibrate_by_held_out_recordings(
    model: FrameImputer, learnt_from: Sequence[Recording], given: Recording, nominal: Prediction
) -> Prediction:
    check = VarianceCheck(given)
    if not check.copies:
        return nominal
    gaps, copies = _sum_in_training(model, learnt_from, check)
    if not gaps[1].any():
        return check.calibrate(nominal, model.impute(check.recordings()))
    own = check.copy_factors(model.impute(check.recordings()[: len(check.copies)]))
    own = own * _measure_growth(gaps, copies, check.steepest)
    return _multiply_variance(nominal, np.maximum((own + mean_ratios(*gaps)) / 2.0, LEAST))


def _sum_in_training(
    model: FrameImputer, learnt_from: Sequence[Recording], check: VarianceCheck
) -> Array:
    """Return the ratios in gaps of held-out recordings, and in a copy if short: (2, 2, D)."""
    given, middle = check.recording, check.copies[len(check.copies) // 2]
    masks = [~given.visible, *([middle] if (check.steepest > 1.0).any() else [])]
    gaps, *copies = sum_ratios_elsewhere(model, learnt_from, given, masks)
    return np.array([gaps, *(copies or [np.zeros_like(gaps)])])


def _measure_growth(gaps: Array, copies: Array, steepest: Array) -> Array:
    """Return by how much ratios grow from copies to gaps: (D,), from sums over all channels."""
    (in_gaps, n_gaps), (in_copies, n_copies) = gaps.sum(axis=1), copies.sum(axis=1)
    if not n_copies:
        return np.ones_like(steepest)
    grown = (in_gaps / n_gaps + _TINY) / (in_copies / n_copies + _TINY)
    return np.asarray(np.clip(grown, 1.0, steepest))


def _calibrate_by_held_out_gaps(
    model: FrameImputer,
    learnt_from: Sequence[Recording],
    recordings: Sequence[Recording],
    nominal: Sequence[Prediction],
) -> list[Prediction]:
    checks = [VarianceCheck(recording) for recording in recordings]
    shown = [without for check in checks for without in check.recordings()]
    held_out = iter(impute_held_out(model, learnt_from, shown))
    least = iter(_least_variances(model, [c.recording for c in checks if c.can_narrow]))
    calibrated = [
        check.calibrate(
            prediction,
            list(islice(held_out, len(check.recordings()))),
            next(least) if check.can_narrow else None,
        )
        for check, prediction in zip(checks, nominal, strict=True)
    ]
    if hasattr(model, "impute_held_out"):  # to learn anew takes it too long
        return calibrated
    return [
        _calibrate_lost_channels(model, learnt_from, *each)
        for each in zip(recordings, nominal, calibrated, strict=True)
    ]


def impute_held_out(
    model: Any, learnt_from: Sequence[Recording], recordings: Sequence[Recording]
) -> list[Prediction]:
    """Return predictions of recordings of which more is hidden, by a model that did not see it.

    If the model has learnt from a recording, its parameters have seen what is held out, and it
    would err less there than in gaps. It then learns anew, unless it says how it is to be asked.
    """
    if not recordings:
        return []
    if hasattr(model, "impute_held_out"):
        predictions: list[Prediction] = model.impute_held_out(recordings)
        return predictions
    known = {recording.name for recording in learnt_from}
    new = [recording for recording in recordings if recording.name not in known]
    of_new = iter(model.impute(new) if new else ())
    return [
        _impute_relearnt(model, learnt_from, one) if one.name in known else next(of_new)
        for one in recordings
    ]


def _impute_relearnt(
    model: FrameImputer, learnt_from: Sequence[Recording], shown: Recording
) -> Prediction:
    relearnt: FrameImputer = clone(model)
    try:
        return relearnt.fit(pool(learnt_from, [shown])).impute([shown])[0]
    except ValueError:  # too little may be left to learn from
        return model.impute([shown])[0]


def _least_variances(model: Any, recordings: Sequence[Recording]) -> Sequence[Array | None]:
    if not (recordings and hasattr(model, "least_variances")):
        return [None] * len(recordings)
    least: list[Array] = model.least_variances(recordings)
    return least


def _calibrate_lost_channels(
    model: FrameImputer,
    learnt_from: Sequence[Recording],
    given: Recording,
    nominal: Prediction,
    calibrated: Prediction,
) -> Prediction:
    r"""Multiply the variances of the channels that are hidden throughout by a factor of their own.

    Nothing of such a channel is visible in the recording, so that no gap in it can be held out.
    Other channels of its unit that are held out throughout tell how strange the recording is, but
    may be easier to tell from the rest. Held-out recordings know the channel, but not this
    recording. With the error ratios o of the former and :math:`t_d` of the latter, variances are
    multiplied by :math:`\sqrt{o\, t_d}`, or by the one that is known, and by 1 at least.
    """
    lost = ~given.visible.any(axis=0)
    estimates = list(_estimate_lost_ratios(model, learnt_from, given)) if lost.any() else []
    if not estimates:
        return calibrated
    factors = np.maximum(np.exp(np.mean(np.log(estimates), axis=0)), 1.0)
    variance = np.where(
        lost, np.asarray(nominal.variance) * factors, np.asarray(calibrated.variance)
    )
    return Prediction(calibrated.mean, variance)


def _estimate_lost_ratios(
    model: FrameImputer, learnt_from: Sequence[Recording], given: Recording
) -> Iterator[Array]:
    """Yield the ratios (D,) in held-out channels, and those in held-out recordings."""
    masks = hold_out_channels(given)
    held_out = impute_held_out(model, learnt_from, [given.hide(mask) for mask in masks])
    ratios = [sum_ratios(given, *each) for each in zip(masks, held_out, strict=True)]
    sums, counts = np.sum([np.zeros((2, len(given.channels))), *ratios], axis=0)
    if counts.any():
        yield np.full(len(counts), sums.sum() / counts.sum() + _TINY)
    (elsewhere,) = sum_ratios_elsewhere(model, learnt_from, given, [~given.visible])
    sums, counts = np.where(~given.visible.any(axis=0), elsewhere, 0.0)
    if counts.any():
        yield mean_ratios(sums, counts) + _TINY
