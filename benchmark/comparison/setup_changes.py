"""What two runs were made of and with, where it differs: parameters, versions, recordings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mocapbench.benchmark.comparison.folds import Pair
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.results.origins import DIGEST_OF, recordings
from mocapbench.reports import Change

__all__ = ["changed_parameters", "changed_provenance", "changed_recordings"]

_OF_THE_DAY = {"started", "wall time", "command line", "acknowledgement"}
_ABSENT = "–"


def changed_parameters(pairs: Iterable[Pair]) -> dict[tuple[str, Change], list[str]]:
    """Return every parameter of an entrant that differs within a pair, with its tasks."""
    tasks: dict[tuple[str, Change], dict[str, None]] = {}
    for one, other in pairs:
        for change in _differing(_texts(one.parameters), _texts(other.parameters)):
            tasks.setdefault((one.address.label, change), {})[one.address.task] = None
    return {change: list(where) for change, where in tasks.items()}


def changed_provenance(first: Side, second: Side) -> list[Change]:
    """Return the versions and facts of machines of all records that differ between two runs."""
    return _differing(_provenance(first), _provenance(second))


def changed_recordings(pairs: Iterable[Pair]) -> list[Change]:
    """Return the recordings of which the two runs had different files, with their digests."""
    return list(
        dict.fromkeys(
            fact for pair in pairs for fact in _differing(*(recordings(record) for record in pair))
        )
    )


def _texts(parameters: Mapping[str, object]) -> dict[str, str]:
    return {name: str(value) for name, value in parameters.items()}


def _provenance(side: Side) -> dict[str, str]:
    """Return the values of each fact in all records, which a resumed run may have several of."""
    values: dict[str, dict[str, None]] = {}
    for record in side:
        for name, value in record.provenance.items():
            if name not in _OF_THE_DAY and not name.startswith(DIGEST_OF):
                values.setdefault(name, {})[value] = None
    return {name: "; ".join(sorted(of_name)) for name, of_name in values.items()}


def _differing(before: Mapping[str, str], after: Mapping[str, str]) -> list[Change]:
    return [
        Change(name, before.get(name, _ABSENT), after.get(name, _ABSENT))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    ]
