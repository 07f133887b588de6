"""Statistics of paired comparisons: whether a difference of two entrants is more than chance.

A difference is an *advantage*: the loss of the second entrant minus that of the first, so that
positive means that the first is better, whatever the metric's direction. `pairing` pairs values,
`means` has the error of a mean over units, `differences`, `signed_ranks` and `posterior` test a
sample of differences, `contrast` puts these together, `families` tests many at once, `power` plans
tests, and `ranking` orders more than two entrants. docs/mathematics/statistics.md explains which of
these is used where, and why.
"""

from mocapbench.metrics.statistics.contrast import ROPE, Contrast, contrast
from mocapbench.metrics.statistics.differences import ALPHA, holm, mean_interval, t_test
from mocapbench.metrics.statistics.families import holm_tests, holm_tests_of_means
from mocapbench.metrics.statistics.means import FEWEST_UNITS, UnitMeans, too_few, unit_means
from mocapbench.metrics.statistics.pairing import pair
from mocapbench.metrics.statistics.posterior import correlated_t_test
from mocapbench.metrics.statistics.power import (
    MOST_UNITS,
    POWER,
    detectable_difference,
    deviation_interval,
    power_of_t_test,
    units_needed,
)
from mocapbench.metrics.statistics.ranking import friedman, group_ranks, mean_ranks, nemenyi
from mocapbench.metrics.statistics.signed_ranks import least_signed_rank_p, signed_rank_test

__all__ = [
    "ALPHA",
    "FEWEST_UNITS",
    "MOST_UNITS",
    "POWER",
    "ROPE",
    "Contrast",
    "UnitMeans",
    "contrast",
    "correlated_t_test",
    "detectable_difference",
    "deviation_interval",
    "friedman",
    "group_ranks",
    "holm",
    "holm_tests",
    "holm_tests_of_means",
    "least_signed_rank_p",
    "mean_interval",
    "mean_ranks",
    "nemenyi",
    "pair",
    "power_of_t_test",
    "signed_rank_test",
    "t_test",
    "too_few",
    "unit_means",
    "units_needed",
]
