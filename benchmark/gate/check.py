"""The regression check: the values of a run beside those of a baseline."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.findings import Finding
from mocapbench.benchmark.gate.reference import ENVIRONMENT, Address, Baseline
from mocapbench.benchmark.gate.rule import Judgement, Verdict, judge
from mocapbench.benchmark.gate.tolerances import Tolerances
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["differences", "find", "updated"]

_GRAVITY = tuple(Verdict)
_REASONS = {Verdict.MOVED: "some fold is worse"}
Troubles = Mapping[tuple[Address, int], Record]


def differences(baseline: Baseline, run: Baseline) -> tuple[str, ...]:
    """Return the names of what differs between the environments of two runs."""
    return tuple(name for name in ENVIRONMENT if baseline.about.get(name) != run.about.get(name))


def find(
    baseline: Baseline, run: Baseline, records: Sequence[Record], tolerances: Tolerances
) -> tuple[Finding, ...]:
    """Return a finding per address of the baseline or the run.

    Parameters
    ----------
    baseline, run : Baseline
    records : sequence of Record
        Of the run, failed ones included.
    tolerances : Tolerances

    Raises
    ------
    UsageError
        If the run has another profile or root seed: its problems or budgets are others.
    """
    for name in ("profile", "seed"):
        if baseline.about.get(name) != run.about.get(name):
            raise UsageError(
                f"--baseline: expected a run of the {name} {baseline.about.get(name)}, got "
                f"{run.about.get(name)}; their values cannot be paired"
            )
    troubles = {
        (_entrant(record), record.fold): record
        for record in records
        if record.status is not Status.OK
    }
    return (*_paired(baseline, run, troubles, tolerances), *_unforeseen(baseline, troubles))


def _paired(
    baseline: Baseline, run: Baseline, troubles: Troubles, tolerances: Tolerances
) -> Iterator[Finding]:
    for address in sorted({*baseline.values, *run.values}):
        expected, found = (side.values.get(address, {}) for side in (baseline, run))
        absent = {fold: _absence(address, fold, troubles) for fold in expected.keys() - found}
        verdicts = {verdict for verdict, _ in absent.values()}
        if found.keys() - expected.keys():
            verdicts.add(Verdict.NEW)
        judgement = _judged(address.metric, expected, found, tolerances)
        if judgement:
            verdicts.add(judgement.verdict)
        verdict = min(verdicts, key=_GRAVITY.index)
        yield Finding(address, verdict, judgement, _told(absent) or _REASONS.get(verdict, ""))


def _judged(
    metric: str, expected: Mapping[int, float], found: Mapping[int, float], tolerances: Tolerances
) -> Judgement | None:
    folds = sorted(expected.keys() & found.keys())
    if not folds:
        return None
    before, after = ([side[fold] for fold in folds] for side in (expected, found))
    return judge(before, after, METRICS.get(metric).loss, tolerances.of(metric))


def _absence(address: Address, fold: int, troubles: Troubles) -> tuple[Verdict, str]:
    """Return what to call a value that the baseline has and the run has not, and why."""
    record = troubles.get((address._replace(metric=""), fold))
    if record is None:
        return Verdict.LOST, f"no finite value of task version {address.version} in this run"
    verdict = Verdict.BROKEN if record.status.broken else Verdict.SKIPPED
    return verdict, f"{record.status}: {record.message}"


def _told(absent: Mapping[int, tuple[Verdict, str]]) -> str:
    """Return why folds are absent, those of one reason together."""
    by_reason: dict[str, list[int]] = {}
    for fold, (_, reason) in sorted(absent.items()):
        by_reason.setdefault(reason, []).append(fold)
    texts = (f"fold {', '.join(map(str, folds))}: {why}" for why, folds in by_reason.items())
    return "; ".join(texts)


def _unforeseen(baseline: Baseline, troubles: Troubles) -> Iterator[Finding]:
    """Yield the failed jobs of which the baseline knows nothing, one an entrant."""
    known = {
        (address._replace(metric=""), fold)
        for address, folds in baseline.values.items()
        for fold in folds
    }
    failed = {
        job[0]: record
        for job, record in troubles.items()
        if record.status.broken and job not in known
    }
    for entrant, record in sorted(failed.items(), key=lambda item: item[0]):
        yield Finding(entrant, Verdict.BROKEN, reason=f"{record.status}: {record.message}")


def _entrant(record: Record) -> Address:
    return Address(record.task, record.version, record.case, record.label, "")


def updated(baseline: Baseline, run: Baseline, records: Sequence[Record]) -> Baseline:
    """Return the run's values as a baseline, and the old ones of what it could not compute.

    Those are values whose recordings are missing where it ran, and those of failed jobs.
    """
    absent = {_entrant(record) for record in records if record.status is not Status.OK}
    kept = {a: v for a, v in baseline.values.items() if a._replace(metric="") in absent}
    values = {a: {**kept.get(a, {}), **run.values.get(a, {})} for a in (*kept, *run.values)}
    return Baseline(values, run.about)
