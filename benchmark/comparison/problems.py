"""Whether two records of one address solve the same problem, and if not, why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.results.origins import recordings
from mocapbench.benchmark.runs.record import Record

__all__ = ["differences", "require_same_problems"]


def require_same_problems(pairs: Sequence[tuple[Record, Record]]) -> None:
    """Refuse pairs that do not solve the same problem.

    Raises
    ------
    UsageError
        If a pair differs in its seed, its task's version or a recording.
    """
    reasons = Counter(reason for pair in pairs for reason in differences(*pair))
    if reasons:
        listed = "; ".join(
            f"{reason} ({format_count(count, 'job')})" for reason, count in reasons.most_common(3)
        )
        raise UsageError(
            f"compare: the two do not solve the same problems, so nothing is paired: {listed}; "
            "compare runs of one seed, one version of the tasks and the same recordings"
        )


def differences(one: Record, other: Record) -> list[str]:
    """Return in what the problems of two records differ, one phrase each."""
    ours, theirs = (_problem(record) for record in (one, other))
    return [
        f"{name} {ours.get(name, 'absent')} against {theirs.get(name, 'absent')}"
        for name in dict.fromkeys([*ours, *theirs])
        if ours.get(name) != theirs.get(name)
    ]


def _problem(record: Record) -> Mapping[str, str]:
    digests = {f"digest of {uri}": value for uri, value in recordings(record).items()}
    task, version = record.address.task, str(record.address.version)
    return {"seed": str(record.seed), f"version of {task}": version, **digests}
