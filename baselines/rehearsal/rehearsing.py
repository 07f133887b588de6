r"""Variances that a recording's own trials and training recordings in its place have checked.

Trials in the recording itself know the person, but are of copies that may be shorter than the gaps,
or leave too little visible. Training recordings in its place, left out of training, have the gaps
as they are. Let :math:`o_d` be the mean ratio of squared errors to claimed variances of channel d
in the recording's own trials, :math:`t_d` the one in training, and g by how much the ratio in
training, over all channels, is larger in gaps than in copies of them that had to be shorter. Both
:math:`g\, o_d` and :math:`t_d` say what variances in the gaps have to be multiplied by. Which of
them is right is not known, and the variance of an equal mixture of both is taken: the factor is
:math:`(g\, o_d + t_d) / 2`, which may be less than 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.in_training import ratios_in_training
from mocapbench.baselines.rehearsal.ratios import LEAST, mean_ratios
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["rehearsed"]


_TINY = np.finfo(np.float64).tiny


def rehearsed(
    model: Widened, recordings: Sequence[Recording], *, learnt_from: Sequence[Recording]
) -> list[Prediction]:
    """Return a model's predictions with variances that trials and training bear out.

    Without training recordings to hold out, or a trial, variances are those of `widened`.

    Parameters
    ----------
    model : Widened
        What it claims of one recording may not depend on the others.
    recordings : sequence of Recording
    learnt_from : sequence of Recording
        Those given to its ``fit``.
    """
    return [
        _rehearsed(model, learnt_from, recording, claimed)
        for recording, claimed in zip(recordings, model.as_claimed(recordings), strict=True)
    ]


def _rehearsed(
    model: Widened, learnt_from: Sequence[Recording], given: Recording, claimed: Prediction
) -> Prediction:
    check = VarianceCheck.of(given)
    if not check.copies:
        return claimed
    gaps, copies = _in_training(model, learnt_from, check)
    if not gaps[1].any():
        return check.applied(claimed, model.as_tried(check.trials()))
    copied = replace(check, halves=[])
    own = copied.factors(model.as_tried(copied.trials())) * _growth(gaps, copies, check.steepest)
    factors = np.maximum((own + mean_ratios(*gaps)) / 2.0, LEAST)
    return Prediction(claimed.mean, np.asarray(claimed.variance) * factors)


def _in_training(model: Widened, learnt_from: Sequence[Recording], check: VarianceCheck) -> Array:
    """Return the ratios in gaps of training recordings, and in a copy if short: (2, 2, D)."""
    given, middle = check.recording, check.copies[len(check.copies) // 2]
    masks = [~given.visible, *([middle] if (check.steepest > 1.0).any() else [])]
    gaps, *copies = ratios_in_training(model, learnt_from, given, masks)
    return np.array([gaps, *(copies or [np.zeros_like(gaps)])])


def _growth(gaps: Array, copies: Array, steepest: Array) -> Array:
    """Return by how much ratios grow from copies to gaps: (D,), from sums over all channels."""
    (in_gaps, n_gaps), (in_copies, n_copies) = gaps.sum(axis=1), copies.sum(axis=1)
    if not n_copies:
        return np.ones_like(steepest)
    grown = (in_gaps / n_gaps + _TINY) / (in_copies / n_copies + _TINY)
    return np.asarray(np.clip(grown, 1.0, steepest))
