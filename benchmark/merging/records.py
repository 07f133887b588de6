"""Which of several records or predictions of one key is kept."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.merging.sources import MergeSource
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["Found", "unite_fits", "unite_records"]

_SHOWN = 10
"""Differences, of which there may be thousands."""


Found = tuple[Record, Path]
"""A record and the file that it is in."""


def unite_records(sources: Sequence[MergeSource]) -> dict[str, Found]:
    """Return one record for each key.

    A job that went well counts rather than one that broke. Which of several equal ones is taken
    does not depend on the order of the sources.

    Raises
    ------
    UsageError
        If two records of one key have different scores.
    """
    found: dict[str, list[Found]] = defaultdict(list)
    for source in sources:
        for key, record in source.records.items():
            found[key].append((record, source.store.record_path(key)))
    _check_agreement(found.values())
    return {key: min(several, key=_preference) for key, several in found.items()}


def _preference(found: Found) -> tuple[bool, str]:
    record, _ = found
    return record.status is not Status.OK, record.to_json()


def _check_agreement(several: Iterable[Sequence[Found]]) -> None:
    differences = [
        text
        for found in several
        for one, other in pairwise([item for item in found if item[0].status is Status.OK])
        for text in _differences(one, other)
    ]
    if differences:
        more = len(differences) - _SHOWN
        shown = [*differences[:_SHOWN], *([f"… and {more} more"] if more > 0 else [])]
        raise UsageError(
            "expected equal scores where two runs have computed the same job, got\n  "
            + "\n  ".join(shown)
            + "\nnothing was written; delete the records that are wrong, or compute them again"
        )


def _differences(one: Found, other: Found) -> list[str]:
    """Return in words which scores of one job differ; NaN is equal to itself."""
    (record, path), (twin, other_path) = one, other
    values, others = ({name: repr(v) for name, v in r.scores.items()} for r in (record, twin))
    return [
        f"{record.address}: {name} {values.get(name, 'none')} in {path}, "
        f"{others.get(name, 'none')} in {other_path}"
        for name in {**values, **others}
        if values.get(name) != others.get(name)
    ]


def unite_fits(sources: Sequence[MergeSource]) -> dict[str, Path]:
    """Return one file of predictions for each key, whatever the order of the sources."""
    found: dict[str, list[Path]] = defaultdict(list)
    for source in sources:
        for key in source.fits:
            found[key].append(source.store.fit_path(key))
    return {key: paths[0] if len(paths) == 1 else _first(paths) for key, paths in found.items()}


def _first(paths: Iterable[Path]) -> Path:
    return min(paths, key=lambda path: hashlib.sha256(path.read_bytes()).hexdigest())
