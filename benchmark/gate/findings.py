"""The findings of a regression check, and the exit code that follows from them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.reference import Series
from mocapbench.benchmark.gate.rule import FAILING, Judgement, Verdict

__all__ = ["Check", "Finding"]


@dataclass(frozen=True)
class Finding:
    """The verdict on one metric of one entrant on one case.

    Parameters
    ----------
    series : Series
        Its metric is empty where a job failed that has no reference value.
    verdict : Verdict
        The gravest of all that is true of it.
    judgement : Judgement or None
        Of the folds that both sides have; None if there are none.
    reason : str
        Why folds are absent, where some are.
    """

    series: Series
    verdict: Verdict
    judgement: Judgement | None = None
    reason: str = ""


@dataclass(frozen=True)
class Check:
    """All findings of a check.

    Parameters
    ----------
    findings : tuple of Finding
        By series.
    environment : Environment
    differing : tuple of str
        What differs between the environments of the run and the reference values.
    strict : bool
        Whether values that the reference does not hold yet fail too.
    """

    findings: tuple[Finding, ...]
    environment: Environment
    differing: tuple[str, ...] = ()
    strict: bool = False
    counts: Mapping[Verdict, int] = field(init=False)

    def __post_init__(self) -> None:
        counts = Counter(finding.verdict for finding in self.findings)
        object.__setattr__(
            self, "counts", {verdict: counts[verdict] for verdict in Verdict if counts[verdict]}
        )

    @property
    def failing(self) -> frozenset[Verdict]:
        """The verdicts for which the exit code is 1."""
        unrecorded = {Verdict.BETTER, Verdict.NEW} if self.strict else frozenset[Verdict]()
        return FAILING[self.environment] | unrecorded

    @property
    def exit_code(self) -> ExitCode:
        """1 if a metric got worse, else 3 if jobs failed, else 4 if nothing could be compared."""
        if self.failing & self.counts.keys():
            return ExitCode.REGRESSION
        if Verdict.BROKEN in self.counts:
            return ExitCode.JOBS_FAILED
        compared = any(finding.judgement for finding in self.findings)
        return ExitCode.OK if compared else ExitCode.NOTHING_RAN
