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
from collections.abc import Callable, Sequence
from typing import NamedTuple

import pandas as pd

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.negative_control_result import (
    Decision,
    Measure,
    NegativeControlResult,
    OffendingCell,
)
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["ENOUGH_CELLS", "LEAST_VARIANCE_RATIO", "NEAR_ZERO", "negative_control"]

NEAR_ZERO = 0.1
LEAST_VARIANCE_RATIO = 0.75
ENOUGH_CELLS = 6


class _Criterion(NamedTuple):
    """What is asked of a measure.

    Parameters
    ----------
    passes : callable
        Whether the mean over all cells, with its interval, meets it.
    low, high : float
        The values that meet it, in a single cell.
    """

    passes: Callable[[FoldMean], bool]
    low: float
    high: float = math.inf

    def meets(self, value: float) -> bool:
        """Return whether the value of one cell meets it."""
        return self.low <= value <= self.high

    def within_reach(self, estimate: FoldMean) -> bool:
        """Return whether the interval of the mean has values that meet it."""
        half = math.inf if estimate.half_width is None else estimate.half_width
        return estimate.mean + half >= self.low and estimate.mean - half <= self.high


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
    control = _measure("MLC", mlc_of_control, _NEAR_ZERO)
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
        _measure("MLC", mlc, _ABOVE_ZERO),
        _measure("MCC", mcc, _ABOVE_ZERO),
        _measure("variance ratio", _column(cells, "variance_ratio", label), _VARIED),
    )


def _column(cells: pd.DataFrame, metric: str, label: str) -> pd.Series[float]:
    """Return the values of the cells where ``label`` has a score."""
    if (metric, label) not in cells:
        return pd.Series(dtype=float, index=cells.index[:0])
    return cells[metric, label].dropna()


def _measure(name: str, values: pd.Series[float], criterion: _Criterion) -> Measure:
    if values.empty:
        return Measure(name, None, Decision.FAILED, ())
    estimate, offending = FoldMean.of(values.to_list()), _offending(values, criterion)
    decision = _decision(estimate, criterion, offending)
    return Measure(name, estimate, decision, offending if decision is Decision.FAILED else ())


def _decision(
    estimate: FoldMean, criterion: _Criterion, offending: Sequence[OffendingCell]
) -> Decision:
    if criterion.passes(estimate):
        return Decision.PASSED
    too_few = estimate.n < ENOUGH_CELLS and criterion.within_reach(estimate)
    return Decision.UNDECIDED if too_few or not offending else Decision.FAILED


def _offending(values: pd.Series[float], criterion: _Criterion) -> tuple[OffendingCell, ...]:
    cells: Sequence[tuple[tuple[str, int], float]] = list(values.items())  # type: ignore[arg-type]
    return tuple(
        OffendingCell(case, fold, value)
        for (case, fold), value in cells
        if not criterion.meets(value)
    )


def _is_above_zero(estimate: FoldMean) -> bool:
    half = estimate.half_width
    return half is not None and estimate.mean - half > 0.0


def _is_near_zero(estimate: FoldMean) -> bool:
    half, size = estimate.half_width, abs(estimate.mean)
    return half is not None and (size <= half or size + half <= NEAR_ZERO)


def _is_varied(estimate: FoldMean) -> bool:
    return estimate.mean >= LEAST_VARIANCE_RATIO


_ABOVE_ZERO = _Criterion(_is_above_zero, low=math.ulp(0.0))  # the least number above 0
_NEAR_ZERO = _Criterion(_is_near_zero, low=-NEAR_ZERO, high=NEAR_ZERO)
_VARIED = _Criterion(_is_varied, low=LEAST_VARIANCE_RATIO)
