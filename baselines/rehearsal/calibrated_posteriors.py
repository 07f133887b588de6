"""Posteriors of a process that knows the recordings, with variances that its errors bear out."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.left_out import LeftOut
from mocapbench.baselines.rehearsal.trials import long_copies
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.datasets import Recording

__all__ = ["calibrate_posterior"]


def calibrate_posterior(
    recording: Recording,
    errors: LeftOut,
    fill: Callable[[Sequence[Recording]], Sequence[Prediction]],
) -> Prediction:
    """Return the posterior of a recording with other variances.

    The variances of a channel are those of the posterior, times the larger of two mean ratios of
    squared errors to variances: that of the recording's own visible entries if they are left out
    one by one, and that of copies of its gaps of three frames or more, which hide more of it. It
    is less than 1 only as far as all entries together bear out. Where copies have to be shorter
    than the gap, the ratio grows with the distance to visible frames as it does in them. The mean
    over all channels counts as ten entries in each (``docs/calibration.md``).

    Parameters
    ----------
    recording : Recording
        One that the process was fitted to.
    errors : LeftOut
        Its posterior, and the errors of its visible entries.
    fill : callable
        Gives the posteriors of such recordings if more of them is hidden, parameters kept.
    """
    check, factors = VarianceCheck.of(recording, long_copies), errors.factors()
    if check.copies:
        factors = np.maximum(factors, check.factors(fill(check.trials())))
    return Prediction(errors.claimed.mean, np.asarray(errors.claimed.variance) * factors)
