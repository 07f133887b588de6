"""A headline of the page, and the phrases that headlines share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.text import apart, decimals, number

__all__ = ["Headline", "cases_phrase", "same_places"]


@dataclass(frozen=True)
class Headline:
    """A sentence about the results.

    Parameters
    ----------
    subject : str
        Its beginning, which the page emphasises.
    text : str
        The rest.
    """

    subject: str
    text: str


def cases_phrase(cases: Sequence[CaseLayout]) -> str:
    """Return how many cases there are, and how many of them are generated."""
    synthetic = sum(case.synthetic for case in cases)
    whole = {1: "the only case", 2: "both cases"}.get(len(cases), f"all {len(cases)} cases")
    return whole + (f" ({synthetic} synthetic)" if synthetic else "")


def same_places(value: float, *others: float) -> list[str]:
    """Return values with one number of decimals for all, which tells the first two apart."""
    values = (value, *others)
    places = apart(value, others[0], decimals(values)) if others else decimals(values)
    return [number(each, places) for each in values]
