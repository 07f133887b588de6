"""The regression check: the values of a run beside the reference values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.findings import Finding
from mocapbench.benchmark.gate.reference import ENVIRONMENT, Folds, Reference, Series
from mocapbench.benchmark.gate.rule import Judgement, Tolerance, Verdict, judge
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

__all__ = ["check", "differences", "update_values"]

_GRAVITY = tuple(Verdict)
_REASONS = {Verdict.MOVED: "some fold is worse"}
Failures = Mapping[Address, Record]


def differences(reference: Reference, run: Reference) -> tuple[str, ...]:
    """Return the names of what differs between the environments of two runs."""
    return tuple(name for name in ENVIRONMENT if reference.about.get(name) != run.about.get(name))


def check(
    reference: Reference,
    run: Reference,
    records: Sequence[Record],
    tolerances: Mapping[str, Tolerance],
) -> tuple[Finding, ...]:
    """Return a finding per series of the reference values or the run.

    Parameters
    ----------
    reference, run : Reference
    records : sequence of Record
        Of the run, failed ones included.
    tolerances : mapping of str to Tolerance

    Raises
    ------
    UsageError
        If the run has another profile or root seed: its problems or budgets are others.
    """
    for name in ("profile", "seed"):
        if reference.about.get(name) != run.about.get(name):
            raise UsageError(
                f"--reference: expected a run of the {name} {reference.about.get(name)}, got "
                f"{run.about.get(name)}; their values cannot be paired"
            )
    failures = {record.address: record for record in records if record.status is not Status.OK}
    unforeseen = _unforeseen(reference, run, failures)
    return (*_pair_values(reference, run, failures, tolerances), *unforeseen)


def _pair_values(
    reference: Reference, run: Reference, failures: Failures, tolerances: Mapping[str, Tolerance]
) -> Iterator[Finding]:
    for series in sorted({*reference.values, *run.values}):
        expected, got = (side.values.get(series, {}) for side in (reference, run))
        absent = {fold: _absence(series, fold, failures) for fold in expected.keys() - got}
        verdicts = {verdict for verdict, _ in absent.values()}
        if got.keys() - expected.keys():
            verdicts.add(Verdict.NEW)
        judgement = _judgement(series.metric, expected, got, tolerances)
        if judgement:
            verdicts.add(judgement.verdict)
        verdict = min(verdicts, key=_GRAVITY.index)
        yield Finding(series, verdict, judgement, _reasons(absent) or _REASONS.get(verdict, ""))


def _judgement(
    metric: str, expected: Folds, got: Folds, tolerances: Mapping[str, Tolerance]
) -> Judgement | None:
    folds = sorted(expected.keys() & got.keys())
    if not folds:
        return None
    before, after = ([side[fold] for fold in folds] for side in (expected, got))
    return judge(before, after, METRICS.get(metric).loss, tolerances[metric])


def _absence(series: Series, fold: int, failures: Failures) -> tuple[Verdict, str]:
    """Return what to call a value that the reference has and the run has not, and why."""
    record = failures.get(series.address._replace(fold=fold))
    if record is None:
        version = series.address.version
        return Verdict.LOST, f"no finite value of task version {version} in this run"
    verdict = Verdict.BROKEN if record.status.broken else Verdict.SKIPPED
    return verdict, f"{record.status}: {record.message}"


def _reasons(absent: Mapping[int, tuple[Verdict, str]]) -> str:
    """Return why folds are absent, those of one reason together."""
    by_reason: dict[str, list[int]] = {}
    for fold, (_, reason) in sorted(absent.items()):
        by_reason.setdefault(reason, []).append(fold)
    texts = (f"fold {', '.join(map(str, folds))}: {why}" for why, folds in by_reason.items())
    return "; ".join(texts)


def _unforeseen(reference: Reference, run: Reference, failures: Failures) -> Iterator[Finding]:
    """Yield the failed jobs that lack no value of the reference, one an entrant."""
    known = {
        series.address._replace(fold=fold)
        for series, folds in reference.values.items()
        for fold in folds.keys() - run.values.get(series, {}).keys()
    }
    failed = {
        address.all_folds: record
        for address, record in failures.items()
        if record.status.broken and address not in known
    }
    for address, record in sorted(failed.items(), key=lambda item: item[0]):
        reason = f"{record.status}: {record.message}"
        yield Finding(Series(address), Verdict.BROKEN, reason=reason)


def update_values(reference: Reference, run: Reference, records: Sequence[Record]) -> Reference:
    """Return the run's values as the new reference; where the run has none, the old one is kept.

    Those are values whose recordings are missing where it ran, and those of failed jobs.
    """
    absent = {record.address.all_folds for record in records if record.status is not Status.OK}
    kept = {s: folds for s, folds in reference.values.items() if s.address in absent}
    values = {s: {**kept.get(s, {}), **run.values.get(s, {})} for s in (*kept, *run.values)}
    return Reference(values, run.about)
