"""How much of the truth the bands of the chosen model hold in trials."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import ndtri

from mocapbench.benchmark.filling.attempt import impute
from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["held"]

_WITHIN_95 = float(ndtri(0.975))
_TRIALS = 3
"""Filled again, the first ones: a model that checks its bands takes several times as long."""


def held(model: str, trials: Sequence[Trial], workers: Workers, seconds: float) -> float | None:
    """Return the share of hidden entries in a model's 95 % bands; None if none were in time.

    Parameters
    ----------
    model : str
    trials : sequence of Trial
    workers : Workers
    seconds : float
        For all that is done here.
    """
    tried = trials[:_TRIALS]
    share = seconds * min(workers.count, len(tried)) / len(tried)
    futures = [workers.submit(model, workers.keep(t.question), share, impute) for t in tried]
    inside = []
    for trial, future in zip(tried, futures, strict=True):
        answer = workers.result(future).answer
        if answer is not None and answer.variance is not None:
            errors = np.abs(answer.mean - trial.truth)
            inside.append(errors <= _WITHIN_95 * np.sqrt(answer.variance))
    return float(np.concatenate(inside).mean()) if inside else None
