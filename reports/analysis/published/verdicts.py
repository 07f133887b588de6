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
    """How our mean compares with a published value, or why there is no comparison."""

    WITHIN_2_PERCENT = "within 2 %"
    WITHIN_PAPER_SD = "within the paper’s ±"
    BETTER = "better"
    WORSE = "worse"
    UNDECIDED = "undecided"
    NOT_COMPARABLE = "not comparable"
    NOT_RUN = "not run"


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
        *Within 2 %* where both the difference and the half-width are; *within the paper's ±*
        where both are, and not within 2 %; *better* or *worse* where the published value lies
        outside our interval widened by the `allowance`, the greater of the two; otherwise
        *undecided*.
    """
    uncertainty, distance = half_width or 0.0, abs(ours - published.value)
    if max(distance, uncertainty) <= RELATIVE_TOLERANCE * abs(published.value):
        return PublishedVerdict.WITHIN_2_PERCENT
    if max(distance, uncertainty) <= (published.two_sd or 0.0):
        return PublishedVerdict.WITHIN_PAPER_SD
    if distance <= allowance(published) + uncertainty:
        return PublishedVerdict.UNDECIDED
    better = info.loss(ours) < info.loss(published.value)
    return PublishedVerdict.BETTER if better else PublishedVerdict.WORSE
