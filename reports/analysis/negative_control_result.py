"""The result of the negative control, entrant by entrant."""

from __future__ import annotations

from dataclasses import dataclass

from mocapbench.reports.analysis.fold_mean import FoldMean

__all__ = ["Measure", "NegativeControlResult", "OffendingCell"]


@dataclass(frozen=True)
class OffendingCell:
    """A cell (one fold of one case) whose value, taken by itself, fails the criterion."""

    case: str
    fold: int
    value: float


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
    passed : bool
    offending : tuple of OffendingCell
        Empty where the measure passed.
    """

    name: str
    estimate: FoldMean | None
    passed: bool
    offending: tuple[OffendingCell, ...]


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
    def passed(self) -> bool:
        """Whether it passes by every measure."""
        return all(measure.passed for measure in self.measures)

    @property
    def n_cells(self) -> int:
        """The number of cells compared, by the measure that has the fewest."""
        return min(measure.estimate.n if measure.estimate else 0 for measure in self.measures)

    @property
    def verdict(self) -> str:
        """``"passed"``, ``"failed"`` or ``"need not pass"``."""
        if self.passed:
            return "passed"
        return "need not pass" if self.exempt else "failed"

    @property
    def failed(self) -> bool:
        """Whether it had to pass and did not."""
        return not (self.passed or self.exempt)
