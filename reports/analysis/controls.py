"""Whether samples resemble the references more than those of an unrelated process do.

A measure of similarity means something only if a *control*, which has learnt nothing, scores worse
(thesis §A.4.1). The check pairs an entrant with the control cell by cell, a cell being one fold of
one case, and takes a 95 % interval by Student's t over all of them:

* an entrant passes where the mean of (its MLC − the control's) has an interval above 0, likewise
  its MCC, and the mean of its variance ratio is at least `LEAST_VARIANCE_RATIO`;
* the control passes where the interval of its mean MLC contains 0 or lies within ± `NEAR_ZERO`.

The variance ratio has a lower limit alone: to draw too little variance raises MCC and MLC, up to
those of a sampler that repeats its trend; to draw too much lowers them, and so gains nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pandas as pd

from mocapbench.reports.analysis.results import Estimate, TaskResults

__all__ = [
    "LEAST_VARIANCE_RATIO",
    "NEAR_ZERO",
    "ControlFinding",
    "Measure",
    "OffendingCell",
    "control_check",
]

NEAR_ZERO = 0.1
LEAST_VARIANCE_RATIO = 0.75


@dataclass(frozen=True)
class OffendingCell:
    """A cell whose value, taken by itself, speaks against the entrant."""

    case: str
    fold: int
    value: float


@dataclass(frozen=True)
class Measure:
    """What the check found by one measure.

    Parameters
    ----------
    name : str
        ``"MLC"``, ``"MCC"`` or ``"variance ratio"``, of which the former are differences for an
        entrant.
    estimate : Estimate or None
        Over all cells; None where there is none.
    passed : bool
    offending : tuple of OffendingCell
        Empty where the measure passed.
    """

    name: str
    estimate: Estimate | None
    passed: bool
    offending: tuple[OffendingCell, ...]


@dataclass(frozen=True)
class ControlFinding:
    """What the check found of one entrant.

    Parameters
    ----------
    label : str
    measures : tuple of Measure
    excuse : str
        Why it need not pass, empty where it must.
    """

    label: str
    measures: tuple[Measure, ...]
    excuse: str = ""

    @property
    def passed(self) -> bool:
        """Whether it passes by every measure."""
        return all(measure.passed for measure in self.measures)

    @property
    def n_cells(self) -> int:
        """In how many cells it was compared, by the measure that has fewest."""
        return min(measure.estimate.n if measure.estimate else 0 for measure in self.measures)

    @property
    def verdict(self) -> str:
        """``"passed"``, ``"failed"`` or ``"need not pass"``."""
        if self.passed:
            return "passed"
        return "need not pass" if self.excuse else "failed"

    @property
    def failed(self) -> bool:
        """Whether it had to pass and did not."""
        return not (self.passed or self.excuse)


def control_check(results: TaskResults) -> tuple[ControlFinding, ...]:
    """Check the control first and then every other entrant, in table order.

    Returns
    -------
    tuple of ControlFinding
        Empty where the control has scores in fewer than two cells, of which no interval is made.
    """
    layout = results.layout
    cells = results.scores.pivot_table(
        index=["case", "fold"], columns=["metric", "label"], values="value"
    )
    of_control = _column(cells, "mlc", layout.control)
    if len(of_control) < 2:
        return ()
    control = _measure("MLC", of_control, _near_zero, lambda value: abs(value) <= NEAR_ZERO)
    return (
        ControlFinding(layout.control, (control,)),
        *(
            ControlFinding(
                label, _measures(cells, label, layout.control), layout.not_controlled.get(label, "")
            )
            for label in layout.labels
            if label != layout.control
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
    passes: Callable[[Estimate], bool],
    is_fine: Callable[[float], bool],
) -> Measure:
    if values.empty:
        return Measure(name, None, False, ())
    estimate = Estimate.of(values.to_list())
    passed = passes(estimate)
    return Measure(name, estimate, passed, () if passed else _offending(values, is_fine))


def _offending(
    values: pd.Series[float], is_fine: Callable[[float], bool]
) -> tuple[OffendingCell, ...]:
    cells: Sequence[tuple[tuple[str, int], float]] = list(values.items())  # type: ignore[arg-type]
    return tuple(
        OffendingCell(case, fold, value) for (case, fold), value in cells if not is_fine(value)
    )


def _above_zero(estimate: Estimate) -> bool:
    half = estimate.half_width
    return half is not None and estimate.mean - half > 0.0


def _near_zero(estimate: Estimate) -> bool:
    half, size = estimate.half_width or 0.0, abs(estimate.mean)
    return size <= half or size + half <= NEAR_ZERO
