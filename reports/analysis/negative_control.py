"""The negative control: whether samples resemble the references more than unrelated samples do.

A measure of similarity is meaningful only if a *control*, whose samples come from an unrelated
process, scores worse than the models (J. D. Gil López, *Hierarchical Multiple Output Gaussian
Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017, §A.4.1).
The check pairs an entrant with the control cell by cell, where a cell is one fold of one case, and
takes a 95 % interval by Student's t over all cells:

* an entrant passes where the mean of (its MLC − the control's) has an interval above 0, likewise
  its MCC, and the mean of its variance ratio is at least `LEAST_VARIANCE_RATIO`;
* the control passes where the interval of its mean MLC contains 0 or lies within ± `NEAR_ZERO`.

The variance ratio has only a lower limit. Samples with too little variance score higher MCC and
MLC, up to the scores of a sampler that repeats its trend. Samples with too much variance score
lower, which gains nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pandas as pd

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.negative_control_result import (
    Measure,
    NegativeControlResult,
    OffendingCell,
)
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["LEAST_VARIANCE_RATIO", "NEAR_ZERO", "negative_control"]

NEAR_ZERO = 0.1
LEAST_VARIANCE_RATIO = 0.75


def negative_control(results: TaskResults) -> tuple[NegativeControlResult, ...]:
    """Check the control first and then every other entrant, in table order.

    Returns
    -------
    tuple of NegativeControlResult
        Empty where the control has scores in fewer than two cells, which give no interval.
    """
    layout = results.layout
    cells = results.scores.pivot_table(
        index=["case", "fold"], columns=["metric", "label"], values="value"
    )
    mlc_of_control = _column(cells, "mlc", layout.control)
    if len(mlc_of_control) < 2:
        return ()
    control = _measure("MLC", mlc_of_control, _near_zero, lambda value: abs(value) <= NEAR_ZERO)
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
        _measure("MLC", mlc, _above_zero, lambda value: value > 0.0),
        _measure("MCC", mcc, _above_zero, lambda value: value > 0.0),
        _measure(
            "variance ratio",
            _column(cells, "variance_ratio", label),
            lambda estimate: estimate.mean >= LEAST_VARIANCE_RATIO,
            lambda value: value >= LEAST_VARIANCE_RATIO,
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
    is_fine: Callable[[float], bool],
) -> Measure:
    if values.empty:
        return Measure(name, None, False, ())
    estimate = FoldMean.of(values.to_list())
    passed = passes(estimate)
    return Measure(name, estimate, passed, () if passed else _offending(values, is_fine))


def _offending(
    values: pd.Series[float], is_fine: Callable[[float], bool]
) -> tuple[OffendingCell, ...]:
    cells: Sequence[tuple[tuple[str, int], float]] = list(values.items())  # type: ignore[arg-type]
    return tuple(
        OffendingCell(case, fold, value) for (case, fold), value in cells if not is_fine(value)
    )


def _above_zero(estimate: FoldMean) -> bool:
    half = estimate.half_width
    return half is not None and estimate.mean - half > 0.0


def _near_zero(estimate: FoldMean) -> bool:
    half, size = estimate.half_width or 0.0, abs(estimate.mean)
    return size <= half or size + half <= NEAR_ZERO
