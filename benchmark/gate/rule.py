"""The rule of the regression gate: when a metric got worse, fold by fold.

Values of the same fold are paired, because a fold is one problem: its difficulty cancels in the
difference. With the losses ℓ of a metric (lower is better whatever its direction), the differences
d_i = ℓ(run_i) − ℓ(reference_i) over n folds have the mean d̄ and the standard error
SE = sd(d) / √n (ddof 1; 0 for one fold, and where all differences are equal). The metric is *worse*
if

    d̄ > max(absolute, relative · |mean reference value|, k · SE),

*better* if −d̄ is, and *moved* if neither holds but some fold lies beyond the first two.

In one environment a program repeats itself, so there `Environment.SAME` lets no fold move for the
worse unless the mean is better; across platforms the folds of a model that searches scatter, and
only their mean is held.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from mocapbench.benchmark.gate.environment import Environment

__all__ = ["DEFAULT_TOLERANCES", "FAILING", "Judgement", "Tolerance", "Verdict", "judge"]


class Verdict(StrEnum):
    """The possible verdicts on one metric, the gravest first."""

    WORSE = "worse"
    LOST = "lost"
    BROKEN = "job failed"
    MOVED = "moved"
    BETTER = "better"
    NEW = "new"
    SKIPPED = "data missing"
    SAME = "same"


@dataclass(frozen=True)
class Tolerance:
    """What a paired difference may be before it counts.

    Parameters
    ----------
    k : float
        Standard errors of the mean paired difference.
    relative : float
        Share of the size of the reference's mean value.
    absolute : float
        In the unit of the metric.
    """

    k: float = 3.0
    relative: float = 1e-9
    absolute: float = 0.0

    def floor(self, scale: float) -> float:
        """Return what a value of size ``scale`` may change by, noise apart."""
        return max(self.absolute, self.relative * abs(scale))


DEFAULT_TOLERANCES = {Environment.SAME: Tolerance(), Environment.CROSS: Tolerance(relative=0.02)}
"""The tolerance unless a metric has one of its own."""

_ALWAYS = frozenset({Verdict.WORSE, Verdict.LOST})
FAILING = {Environment.SAME: _ALWAYS | {Verdict.MOVED}, Environment.CROSS: _ALWAYS}
"""The verdicts that fail the gate."""


@dataclass(frozen=True)
class Judgement:
    """The paired values of one metric, and the verdict on them.

    Parameters
    ----------
    verdict : Verdict
    reference, run : float
        Means over the paired folds.
    change : float
        Mean difference of the losses; positive is worse.
    worst : float
        The largest difference of one fold.
    allowance : float
        What ``change`` may be.
    n : int
        Number of paired folds.
    """

    verdict: Verdict
    reference: float
    run: float
    change: float
    worst: float
    allowance: float
    n: int


def judge(
    reference: Sequence[float],
    run: Sequence[float],
    loss: Callable[[float], float],
    tolerance: Tolerance,
) -> Judgement:
    """Return whether the values of ``run`` are worse than those of ``reference``.

    Parameters
    ----------
    reference, run : sequence of n float
        Finite values of one metric, paired by fold.
    loss : callable
        How bad a value is, lower being better: `mocapbench.metrics.Metric.loss`.
    tolerance : Tolerance

    Raises
    ------
    ValueError
        If there is no pair, or a value is not finite.
    """
    pairs = np.array([reference, run], dtype=np.float64)
    if pairs.size == 0 or not np.isfinite(pairs).all():
        raise ValueError(f"expected finite values in pairs, got {reference!r} and {run!r}")
    losses = np.array([[loss(value) for value in values] for values in pairs.tolist()])
    differences = losses[1] - losses[0]
    before, after = pairs.mean(axis=1).tolist()
    change, n = float(differences.mean()), len(differences)
    error = float(differences.std(ddof=1)) / math.sqrt(n) if n > 1 else 0.0
    floor = tolerance.floor(before)
    allowance = max(floor, tolerance.k * error)
    worst, best = float(differences.max()), float(differences.min())
    verdict = _verdict(change, worst, best, floor, allowance)
    return Judgement(verdict, before, after, change, worst, allowance, n)


def _verdict(change: float, worst: float, best: float, floor: float, allowance: float) -> Verdict:
    if change > allowance:
        return Verdict.WORSE
    if change < -allowance:
        return Verdict.BETTER
    if worst > floor:
        return Verdict.MOVED
    return Verdict.BETTER if best < -floor else Verdict.SAME
