"""The rule of the verdicts on our numbers beside the published ones.

A verdict needs two things: whether our mean agrees with the published value, and whether the folds
determine our mean precisely enough. Noise in our folds can only turn a verdict into *undecided*.
"""

from __future__ import annotations

from enum import Enum

from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.paper.published import PublishedValue

__all__ = ["RELATIVE_TOLERANCE", "PublishedVerdict", "allowance", "verdict"]

RELATIVE_TOLERANCE = 0.02


class PublishedVerdict(Enum):
    """How our mean compares with a published value."""

    REPRODUCED = "reproduced"
    BETTER = "better"
    WORSE = "worse"
    UNDECIDED = "undecided"
    NOT_COMPARABLE = "not comparable"


def allowance(published: PublishedValue) -> float:
    """Return how far from ``published`` a mean still agrees: 2 % of it, or its ± if greater."""
    return max(RELATIVE_TOLERANCE * abs(published.value), published.two_sd or 0.0)


def verdict(
    ours: float, published: PublishedValue, info: MetricInfo, half_width: float | None = None
) -> PublishedVerdict:
    """Compare our mean with a published value.

    Parameters
    ----------
    ours : float
        Our mean.
    published : PublishedValue
    info : MetricInfo
        Its direction says which of two values is better.
    half_width : float or None
        Half the 95 % interval of our mean. Without one the rule uses the mean alone.

    Returns
    -------
    PublishedVerdict
        *Reproduced* where both the difference and the half-width are within the `allowance`;
        *better* or *worse* where the published value lies outside our interval widened by the
        allowance; otherwise *undecided*.
    """
    allowed, uncertainty = allowance(published), half_width or 0.0
    distance = abs(ours - published.value)
    if max(distance, uncertainty) <= allowed:
        return PublishedVerdict.REPRODUCED
    if distance <= allowed + uncertainty:
        return PublishedVerdict.UNDECIDED
    better = info.loss(ours) < info.loss(published.value)
    return PublishedVerdict.BETTER if better else PublishedVerdict.WORSE
