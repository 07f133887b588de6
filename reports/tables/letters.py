"""The lettered notes of a task, each once for all of its tables."""

from __future__ import annotations

from mocapbench.reports.analysis.comparisons import every_comparison
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.remarks import marks

__all__ = ["letters"]


def letters(results: TaskResults) -> dict[str, str]:
    """Return a letter for each erratum of the paper and each reason against a comparison.

    Returns
    -------
    dict of str to str
        In the order of the tables; ``""`` has no letter.
    """
    pairs = every_comparison(results)
    return marks(note for pair in pairs for note in (pair.published.erratum, pair.reason))
