"""The negative control: whether samples resemble the references more than unrelated samples do.

A measure of similarity is meaningful only if a *control*, whose samples come from an unrelated
process, scores worse than the models (J. D. Gil López, *Hierarchical Multiple Output Gaussian
Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017, §A.4.1).
The check pairs an entrant with the control cell by cell, where a cell is one fold of one case, and
takes a 95 % interval by Student's t over all cells:

* an entrant passes where the mean of (its MLC − the control's) has an interval above 0, likewise
  its MCC, and the mean of its variance ratio is at least `LEAST_VARIANCE_RATIO`;
* the control passes where the interval of its mean MLC contains 0 or lies within ± `NEAR_ZERO`.

What does not pass has failed, unless the cells are too few to tell, and it is *undecided*:

* fewer than `ENOUGH_CELLS` do not pass, but their interval reaches what would;
* or every single cell, taken by itself, meets the criterion, and only the interval does not.

`ENOUGH_CELLS` is the least n of which a one-sided sign test can reject at 2.5 %: 2⁻ⁿ ≤ 0.025.
Below it, no test without the assumption of normality separates even an entrant that is better in
every cell.

The variance ratio has only a lower limit. Samples with too little variance score higher MCC and
MLC, up to the scores of a sampler that repeats its trend. Samples with too much variance score
lower, which gains nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import pandas as pd

from mocapbench.reports.analysis.estimates import FoldMean
from mocapbench.reports.analysis.results import TaskResults

__all__ = [
    "ENOUGH_CELLS",
    "EXEMPT",
    "LEAST_VARIANCE_RATIO",
    "NEAR_ZERO",
    "Decision",
    "Measure",
    "NegativeControlResult",
    "negative_control",
]

NEAR_ZERO = 0.1
LEAST_VARIANCE_RATIO = 0.75
LEAST_ABOVE_ZERO = math.ulp(0.0)
ENOUGH_CELLS = 6
EXEMPT = "need not pass"


class Decision(StrEnum):
    """What the cells say of a criterion, the gravest first."""

    FAILED = "failed"
    UNDECIDED = "undecided"
    """The cells are too few to tell."""
    PASSED = "passed"


@dataclass(frozen=True)
class Measure:
    """The result by one measure.

    Parameters
    ----------
    name : str
        ``"MLC"``, ``"MCC"`` or ``"variance ratio"``. For an entrant the first two are
        differences from the control.
    estimate : FoldMean or None
        The mean over all cells; None where there is none.
    decision : Decision
    offending : mapping of (case, fold) to float
        The cells whose value, taken by itself, fails the criterion; empty unless the measure
        failed.
    """

    name: str
    estimate: FoldMean | None
    decision: Decision
    offending: Mapping[tuple[str, int], float]


@dataclass(frozen=True)
class NegativeControlResult:
    """The result of one entrant.

    Parameters
    ----------
    label : str
    measures : tuple of Measure
    exempt : str
        Why it need not pass, empty where it must.
    """

    label: str
    measures: tuple[Measure, ...]
    exempt: str = ""

    @property
    def decision(self) -> Decision:
        """The gravest by any measure."""
        return min((measure.decision for measure in self.measures), key=list(Decision).index)

    @property
    def n_cells(self) -> int:
        """The number of cells compared, by the measure that has the fewest."""
        return min(measure.estimate.n if measure.estimate else 0 for measure in self.measures)

    @property
    def verdict(self) -> str:
        """``"passed"``, ``"failed"``, ``"undecided"`` or ``"need not pass"``."""
        exempt = self.exempt and self.decision is not Decision.PASSED
        return EXEMPT if exempt else self.decision.value

    @property
    def failed(self) -> bool:
        """Whether it had to pass and did not."""
        return self.decision is Decision.FAILED and not self.exempt

    @property
    def undecided(self) -> bool:
        """Whether it has to pass, and cells are too few to tell whether it does."""
        return self.decision is Decision.UNDECIDED and not self.exempt


def negative_control(results: TaskResults) -> tuple[NegativeControlResult, ...]:
    """Check the control first and then every other entrant, in table order.

    Returns
    -------
    tuple of NegativeControlResult
        Empty where the control has no score.
    """
    layout = results.layout
    cells = results.scores.pivot_table(
        index=["case", "fold"], columns=["metric", "label"], values="value"
    )
    mlc_of_control = _column(cells, "mlc", layout.control)
    if mlc_of_control.empty:
        return ()
    control = _measure("MLC", mlc_of_control, _is_near_zero, -NEAR_ZERO, NEAR_ZERO)
    entrants = [label for label in layout.labels if label != layout.control]
    return (
        NegativeControlResult(layout.control, (control,)),
        *(
            NegativeControlResult(
                label, _measures(cells, label, layout.control), layout.page.exempt.get(label, "")
            )
            for label in entrants
        ),
    )


def _measures(cells: pd.DataFrame, label: str, control: str) -> tuple[Measure, ...]:
    mlc, mcc = (
        (_column(cells, metric, label) - _column(cells, metric, control)).dropna()
        for metric in ("mlc", "mcc")
    )
    return (
        _measure("MLC", mlc, _is_above_zero, LEAST_ABOVE_ZERO),
        _measure("MCC", mcc, _is_above_zero, LEAST_ABOVE_ZERO),
        _measure(
            "variance ratio",
            _column(cells, "variance_ratio", label),
            _is_varied,
            LEAST_VARIANCE_RATIO,
        ),
    )


def _column(cells: pd.DataFrame, metric: str, label: str) -> pd.Series[float]:
    """Return the values of the cells where ``label`` has a score."""
    if (metric, label) not in cells:
        return pd.Series(dtype=float, index=cells.index[:0])
    return cells[metric, label].dropna()


def _measure(
    name: str,
    values: pd.Series[float],
    passes: Callable[[FoldMean], bool],
    low: float,
    high: float = math.inf,
) -> Measure:
    """Return the result by one measure.

    Parameters
    ----------
    name : str
    values : Series
        By cell.
    passes : callable
        Whether the mean over all cells, with its interval, meets the criterion.
    low, high : float
        The values that meet it, in a single cell.
    """
    if values.empty:
        return Measure(name, None, Decision.FAILED, {})
    estimate = FoldMean.of(values.to_list())
    offending: dict[Any, float] = values[~values.between(low, high)].to_dict()
    half = math.inf if estimate.half_width is None else estimate.half_width
    within_reach = estimate.mean + half >= low and estimate.mean - half <= high
    if passes(estimate):
        return Measure(name, estimate, Decision.PASSED, {})
    if not offending or (estimate.n < ENOUGH_CELLS and within_reach):
        return Measure(name, estimate, Decision.UNDECIDED, {})
    return Measure(name, estimate, Decision.FAILED, offending)


def _is_above_zero(estimate: FoldMean) -> bool:
    half = estimate.half_width
    return half is not None and estimate.mean - half > 0.0


def _is_near_zero(estimate: FoldMean) -> bool:
    half, size = estimate.half_width, abs(estimate.mean)
    return half is not None and (size <= half or size + half <= NEAR_ZERO)


def _is_varied(estimate: FoldMean) -> bool:
    return estimate.mean >= LEAST_VARIANCE_RATIO
