r"""Channels that are hidden throughout a recording, and what a model's claims of them are worth.

Nothing of such a channel is visible in the recording, so that no trial can hide a part of it. In
trials other channels of its unit are hidden throughout in its place: they tell how strange the
recording is, but another channel may be easier to tell from the rest. Training recordings that take
the place of the one to fill know the channel, but not this recording. With the mean ratios o and
:math:`t_d` of squared errors to claimed variances in the trials, and of channel d in training,
variances are multiplied by :math:`\sqrt{o\, t_d}`, or by the one that is known, and by 1 at least.
``docs/calibration.md`` has what else was tried.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.in_training import ratios_in_training
from mocapbench.baselines.rehearsal.ratios import mean_ratios, squared_ratios
from mocapbench.baselines.rehearsal.trials import spread_evenly
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["lost_trials", "with_lost_channels"]


_TINY = np.finfo(np.float64).tiny


def lost_trials(recording: Recording) -> list[Mask]:
    """Return what each trial hides in place of channels that are hidden throughout: masks (N, D).

    As many neighbouring channels of the same unit, but half of those visible at most, which is none
    if there is one. Their places are spread evenly over the channels.

    Parameters
    ----------
    recording : Recording
    """
    return spread_evenly(lambda place: _trial(recording, place))


def _trial(recording: Recording, place: float) -> Mask:
    mask = np.zeros_like(recording.visible)
    lost, units = _lost(recording), np.array(recording.units)
    for unit in np.unique(units[lost]):
        shown = np.flatnonzero((units == unit) & ~lost)
        n_hidden = min(int((lost & (units == unit)).sum()), len(shown) // 2)
        first = int(place * (len(shown) - n_hidden + 1))
        mask[:, shown[first : first + n_hidden]] = True
    return mask


def with_lost_channels(
    model: Widened,
    learnt_from: Sequence[Recording],
    given: Recording,
    checked: Prediction,
) -> Prediction:
    """Return a prediction with honest variances of the channels that are hidden throughout.

    Parameters
    ----------
    model : Widened
        Fitted.
    learnt_from : sequence of Recording
        Those given to its ``fit``.
    given : Recording
        The recording to fill.
    checked : Prediction
        Its prediction, with variances that trials of other gaps bear out.
    """
    lost = _lost(given)
    estimates = list(_estimates(model, learnt_from, given)) if lost.any() else []
    if not estimates:
        return checked
    (claimed,) = model.as_claimed([given])
    factors = np.maximum(np.exp(np.mean(np.log(estimates), axis=0)), 1.0)
    variance = np.where(lost, np.asarray(claimed.variance) * factors, np.asarray(checked.variance))
    return Prediction(checked.mean, variance)


def _estimates(
    model: Widened, learnt_from: Sequence[Recording], given: Recording
) -> Iterator[Array]:
    """Yield the ratios (D,) that trials show, and those that training shows."""
    masks = lost_trials(given)
    answers = model.as_tried([given.hide(mask) for mask in masks])
    ratios = [squared_ratios(given, *each) for each in zip(masks, answers, strict=True)]
    sums, counts = np.sum([np.zeros((2, len(given.channels))), *ratios], axis=0)
    if counts.any():
        yield np.full(len(counts), sums.sum() / counts.sum() + _TINY)
    (training,) = ratios_in_training(model, learnt_from, given, [~given.visible])
    sums, counts = np.where(_lost(given), training, 0.0)
    if counts.any():
        yield mean_ratios(sums, counts) + _TINY


def _lost(recording: Recording) -> NDArray[np.bool_]:
    return np.asarray(~recording.visible.any(axis=0))
