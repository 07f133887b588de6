"""The result of the negative control, entrant by entrant."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from mocapbench.reports.analysis.fold_mean import FoldMean

__all__ = ["EXEMPT", "Decision", "Measure", "NegativeControlResult", "OffendingCell"]


EXEMPT = "need not pass"


class Decision(StrEnum):
    """What the cells say of a criterion, the gravest first."""

    FAILED = "failed"
    UNDECIDED = "undecided"
    """The cells are too few to tell."""
    PASSED = "passed"


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
    decision : Decision
    offending : tuple of OffendingCell
        Empty unless the measure failed.
    """

    name: str
    estimate: FoldMean | None
    decision: Decision
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
