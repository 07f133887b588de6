"""Variances that a recording's own trials have checked.

A model may claim too much of a recording that is unlike its training, such as the walk of a
stranger. Trials hide more of the recording where the truth is visible, and the variances of the
gaps are multiplied by what they show (`variance_check`). Means stay as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.lost_channels import with_lost_channels
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.datasets import Recording

__all__ = ["widened"]


def widened(
    model: Widened, recordings: Sequence[Recording], *, learnt_from: Sequence[Recording] = ()
) -> list[Prediction]:
    """Return a model's predictions of recordings, with variances that their trials bear out.

    Parameters
    ----------
    model : Widened
        What it claims of one recording may not depend on the others.
    recordings : sequence of Recording
    learnt_from : sequence of Recording, default=()
        What it has learnt from, for channels that are hidden throughout a recording. Without it
        they are left to the trials of other gaps.
    """
    checks = [VarianceCheck.of(recording) for recording in recordings]
    trials = [trial for check in checks for trial in check.trials()]
    answers = iter(model.as_tried(trials) if trials else ())
    claims = model.as_claimed(recordings)
    least = iter(model.least_claimed([check.recording for check in checks if check.can_narrow]))
    filled = [
        check.applied(
            claimed,
            list(islice(answers, check.n_trials)),
            next(least) if check.can_narrow else None,
        )
        for check, claimed in zip(checks, claims, strict=True)
    ]
    if not learnt_from:
        return filled
    return [
        with_lost_channels(model, learnt_from, recording, prediction)
        for recording, prediction in zip(recordings, filled, strict=True)
    ]
