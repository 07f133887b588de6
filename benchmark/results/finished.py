"""Whether a run has finished already, and nothing that it depends on is new since.

Such a run is answered from its own files: planning it again would load every library that models
compute with, to find the same keys.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import REGISTRIES
from mocapbench.benchmark.results.drawn import digest_code, read_stamp, stamp
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.key_parts import LIBRARIES
from mocapbench.benchmark.runs.posed import PosedProblems
from mocapbench.benchmark.runs.record import Record, Status

if TYPE_CHECKING:
    from mocapbench.datasets import Archive

__all__ = ["describe_basis", "finished_records"]


def describe_basis(asked: Sequence[Any], digests: Mapping[str, str]) -> dict[str, Any]:
    """Return what a plan follows from, for `finished_records` of a later run.

    Of code of others nothing tells which files it reads: with it there, a plan follows from more.

    Parameters
    ----------
    asked : sequence
        What the user asked for, as JSON can hold it.
    digests : mapping of str to str
        Of each recording by address.
    """
    if _uses_others():
        return {}
    versions = {name: importlib.metadata.version(name) for name in LIBRARIES}
    contents = [list(asked), versions, digest_code(), dict(digests)]
    basis = hashlib.sha256(json.dumps(contents, sort_keys=True).encode()).hexdigest()
    return {"basis": basis, "recordings": sorted(digests)}


def finished_records(store: RunDirectory, asked: Sequence[Any], archive: Archive) -> list[Record]:
    """Return the records of a run whose plan and report are as they would be now; none otherwise.

    Parameters
    ----------
    store : RunDirectory
    asked : sequence
        As for `describe_basis`.
    archive : Archive
        Where the recordings are now.

    Raises
    ------
    DigestMismatch
        If a recording is here but is not the registered one.
    """
    try:
        plan = store.load_plan()
    except UsageError:  # no run got so far
        return []
    uris = plan.get("recordings", [])
    if "basis" not in plan or _uses_others() or not _are_here(uris, archive):
        return []
    if plan["basis"] != describe_basis(asked, {u: archive.digest(u) for u in uris})["basis"]:
        return []
    records = [record for key in plan["keys"] if (record := store.load(key)) is not None]
    whole = len(records) == len(plan["keys"]) and not any(map(_is_open, records))
    return records if whole and _is_drawn(store, plan, records) else []


def _uses_others() -> bool:
    return any(registry.names_of_others() for registry in REGISTRIES)


def _are_here(uris: Iterable[str], archive: Archive) -> bool:
    try:
        return all(map(archive.available, uris))
    except ValueError:  # an address that no library knows
        return False


def _is_open(record: Record) -> bool:
    """Return whether a job is to be tried again."""
    return record.status.broken or record.status is Status.DATA_MISSING


def _is_drawn(store: RunDirectory, plan: Mapping[str, Any], records: Sequence[Record]) -> bool:
    """Return whether the report there shows the records, all of one problem for each fold."""
    posed = PosedProblems()
    same = all(posed.check_record(record) is record for record in records)
    return same and read_stamp(store, plan) == stamp(records)
