"""Statistics of paired comparisons: whether a difference of two entrants is more than chance.

A difference is an *advantage*: the loss of the second entrant minus that of the first, so that
positive means that the first is better, whatever the metric's direction. `pairing` pairs
values, `differences` and `posterior` test a sample of differences, `contrast` puts these together,
`families` tests many at once, and `ranking` orders more than two entrants. docs/statistics.md
explains which of these is used where, and why.
"""

from mocapbench.metrics.statistics.contrast import ROPE, Contrast, contrast
from mocapbench.metrics.statistics.differences import (
    ALPHA,
    FEWEST_UNITS,
    holm,
    least_signed_rank_p,
    mean_interval,
    signed_rank_test,
    t_test,
)
from mocapbench.metrics.statistics.families import (
    HolmTests,
    holm_tests,
    holm_tests_of_means,
    means_and_errors,
)
from mocapbench.metrics.statistics.pairing import pair
from mocapbench.metrics.statistics.posterior import Posterior, correlated_t_test
from mocapbench.metrics.statistics.ranking import RankComparison, compare_ranks, nemenyi

__all__ = [
    "ALPHA",
    "FEWEST_UNITS",
    "ROPE",
    "Contrast",
    "HolmTests",
    "Posterior",
    "RankComparison",
    "compare_ranks",
    "contrast",
    "correlated_t_test",
    "holm",
    "holm_tests",
    "holm_tests_of_means",
    "least_signed_rank_p",
    "mean_interval",
    "means_and_errors",
    "nemenyi",
    "pair",
    "signed_rank_test",
    "t_test",
]
