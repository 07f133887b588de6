"""Reference values: the stored values of every fold that a run is compared with."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.address import Address

__all__ = [
    "COLUMNS",
    "ENVIRONMENT",
    "REQUEST",
    "Folds",
    "Reference",
    "Series",
    "join_facts",
    "of_records",
]

ENVIRONMENT = (
    *("machine", "libc", "BLAS"),
    *(f"{library} version" for library in ("numpy", "scipy", "scikit-learn")),
)
REQUEST = ("profile", "seed")
_UNKNOWN = "unknown"
COLUMNS = ("task", "version", "case", "label", "metric")


class Series(NamedTuple):
    """One metric of one entrant on one case, over all folds.

    Parameters
    ----------
    address : Address
        Of all folds.
    metric : str
        Empty where a job is meant rather than a value.
    """

    address: Address
    metric: str = ""

    @property
    def cells(self) -> tuple[object, ...]:
        """The cells of its row in a file."""
        address = self.address
        return (address.task, address.version, address.case, address.label, self.metric)

    def __str__(self) -> str:
        return ", ".join(map(str, self.cells))


Folds = Mapping[int, float]


@dataclass(frozen=True)
class Reference:
    """Values by series and fold, and what they were computed with.

    Parameters
    ----------
    values : mapping of Series to mapping of int to float
        Finite values by fold.
    about : mapping of str to str
        Profile, seed, and what decides the last digits; where records differ, all their values.
    """

    values: Mapping[Series, Folds]
    about: Mapping[str, str] = field(default_factory=dict)


def of_records(records: Sequence[Record], plan: Mapping[str, Any]) -> Reference:
    """Return the finite scores of a run.

    Parameters
    ----------
    records : sequence of Record
    plan : mapping
        The run's request, as the store keeps it.
    """
    values: dict[Series, dict[int, float]] = {}
    for record in records:
        for metric, value in record.scores.items():
            if math.isfinite(value):
                series = Series(record.address.all_folds, metric)
                values.setdefault(series, {})[record.address.fold or 0] = value
    request = {name: plan["provenance"].get(name, _UNKNOWN) for name in REQUEST}
    scored = [record.provenance for record in records if record.scores]
    return Reference(values, {**request, **join_facts(scored, ENVIRONMENT)})


def join_facts(parts: Sequence[Mapping[str, str]], names: Iterable[str]) -> dict[str, str]:
    """Return what ``parts`` hold under ``names``, side by side where they differ."""
    held = {name: sorted({part.get(name, _UNKNOWN) for part in parts}) for name in names}
    return {name: " and ".join(values) for name, values in held.items()}
