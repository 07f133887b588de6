"""What a regression check found, and the exit code that follows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.gate.reference import Address
from mocapbench.benchmark.gate.rule import Environment, Judgement, Verdict

__all__ = ["Check", "Finding"]


@dataclass(frozen=True)
class Finding:
    """What became of one metric of one entrant on one case.

    Parameters
    ----------
    address : Address
        Its metric is empty where a job failed that has no baseline.
    verdict : Verdict
        The gravest of all that is true of it.
    judgement : Judgement or None
        Of the folds that both sides have; None if there are none.
    reason : str
        Why folds are absent, where some are.
    """

    address: Address
    verdict: Verdict
    judgement: Judgement | None = None
    reason: str = ""


@dataclass(frozen=True)
class Check:
    """Everything that a check found.

    Parameters
    ----------
    findings : tuple of Finding
        By address.
    environment : Environment
    differing : tuple of str
        What differs between the environments of run and baseline.
    strict : bool
        Whether what the baseline does not hold yet fails too.
    """

    findings: tuple[Finding, ...]
    environment: Environment
    differing: tuple[str, ...] = ()
    strict: bool = False
    counts: Mapping[Verdict, int] = field(init=False)

    def __post_init__(self) -> None:
        counts = Counter(finding.verdict for finding in self.findings)
        object.__setattr__(self, "counts", {each: counts[each] for each in Verdict if counts[each]})

    @property
    def failing(self) -> frozenset[Verdict]:
        """The verdicts for which the exit code is 1."""
        unrecorded = {Verdict.BETTER, Verdict.NEW} if self.strict else frozenset[Verdict]()
        return self.environment.failing | unrecorded

    @property
    def exit_code(self) -> ExitCode:
        """Worse before broken before nothing; a run that was compared to nothing is never fine."""
        if self.failing & self.counts.keys():
            return ExitCode.REGRESSION
        if Verdict.BROKEN in self.counts:
            return ExitCode.JOBS_FAILED
        compared = any(finding.judgement for finding in self.findings)
        return ExitCode.OK if compared else ExitCode.NOTHING_RAN
