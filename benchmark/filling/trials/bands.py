"""How much of the truth the bands of the chosen model hold in trials."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import ndtri

from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["Coverage", "coverage"]

_WITHIN_95 = float(ndtri(0.975))
_TRIALS = 3
"""Filled again, the first ones: a model that checks its bands takes several times as long."""


class Coverage(NamedTuple):
    """The share of hidden entries in 95 % bands, of how many entries and of how many gaps."""

    share: float
    n_entries: int
    n_gaps: int


def coverage(
    model: str, trials: Sequence[Trial], workers: Workers, seconds: float
) -> Coverage | None:
    """Return how much of what trials hide is in a model's bands; None if none were in time.

    Parameters
    ----------
    model : str
    trials : sequence of Trial
    workers : Workers
    seconds : float
        For all that is done here.
    """
    tried = trials[:_TRIALS]
    share = seconds / np.ceil(len(tried) / workers.count)
    running = {workers.submit(model, workers.keep(t.question), share, "impute"): t for t in tried}
    inside, n_gaps = [], 0
    while running:
        for future in workers.ended(running.keys()):
            trial, answer = running.pop(future), workers.result(future).answer
            if answer is not None and answer.variance is not None:
                errors = np.abs(answer.mean - trial.truth)
                inside.append(errors <= _WITHIN_95 * np.sqrt(answer.variance))
                n_gaps += len(trial.units)
    if not inside:
        return None
    within = np.concatenate(inside)
    return Coverage(float(within.mean()), len(within), n_gaps)
