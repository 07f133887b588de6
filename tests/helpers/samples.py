"""Samples for tests of drawings."""

from mocapbench.reports.analysis.fold_sample import FoldSample

__all__ = ["draws"]


def draws(values):
    """Return the sample of values that are independent draws of one case, such as of toy data."""
    units = [f"fold {number} of row" for number in range(len(values))]
    return FoldSample.of([*map(float, values)], units, ["row"] * len(values))
