"""Merging run directories: everything is read and checked before anything is written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mocapbench.basics.temporaries import sweep, temporary_folder
from mocapbench.basics.whole_files import write_bytes
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.merging.reconcile import (
    read_merged_run,
    unite_fits,
    unite_plans,
    unite_records,
)
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.key_parts import KeyEntry

__all__ = ["Merged", "merge"]


@dataclass(frozen=True)
class Merged:
    """What was merged.

    Parameters
    ----------
    records, fits : mapping of str to Path
        The files that were kept, by key.
    keys : mapping of str to KeyEntry
        What keys cover.
    plan : mapping
        The plan of all.
    damaged : tuple of str
        What was left out.
    busy : tuple of Path
        The folders that a run was writing to.
    """

    records: dict[str, Path]
    fits: dict[str, Path]
    keys: dict[str, KeyEntry]
    plan: dict[str, Any]
    damaged: tuple[str, ...]
    busy: tuple[Path, ...]


def merge(paths: Sequence[Path], out: Path) -> Merged:
    """Unite run directories into ``out``; a run that is there takes part.

    Parameters
    ----------
    paths : sequence of Path
        Run directories.
    out : Path
        A new or empty folder, or a run directory.

    Raises
    ------
    UsageError
        If a folder is not as expected, or the runs contradict each other; then nothing is written.
    """
    RunDirectory.require_usable(out)
    if not RunDirectory.is_run(out):
        merged = _unite_runs(paths)
        with _made_at_once(out) as folder:
            _write(merged, RunDirectory.create(folder))
        return merged
    with RunDirectory(out).locked():
        named = [out if path.resolve() == out.resolve() else path for path in paths]
        merged = _unite_runs(named if out in named else [out, *named], locked=out)
        store = RunDirectory(out)
        store.sweep()
        _write(merged, store)
    return merged


def _unite_runs(paths: Sequence[Path], locked: Path | None = None) -> Merged:
    if len(paths) < 2:
        raise UsageError(f"expected two run directories or more, got {paths[0]}; name another")
    distinct = {path.resolve(): path for path in paths}
    merged = [read_merged_run(path) for path in distinct.values()]
    records = unite_records(merged)
    entries = {key: entry for run in reversed(merged) for key, entry in run.keys.items()}
    return Merged(
        records={key: path for key, (_, path) in records.items()},
        fits=unite_fits(merged),
        keys=entries,
        plan=unite_plans(merged, records, entries),
        damaged=tuple(message for run in merged for message in run.store.damaged),
        busy=tuple(
            path for path in distinct.values() if path != locked and RunDirectory(path).is_locked
        ),
    )


@contextmanager
def _made_at_once(out: Path) -> Iterator[Path]:
    """Give a folder that takes the name ``out`` only when it is complete."""
    out.parent.mkdir(parents=True, exist_ok=True)
    sweep(out.parent)
    with temporary_folder(out.parent) as folder:
        complete = folder / "run"
        yield complete
        complete.replace(out)


def _write(merged: Merged, store: RunDirectory) -> None:
    """Write predictions before the records that stand on them, and the plan last."""
    for key, path in merged.fits.items():
        _copy(path, store.fit_path(key))
    for key, path in merged.records.items():
        _copy(path, store.record_path(key))
    store.keep_keys(merged.keys)
    store.save_plan(merged.plan)


def _copy(file: Path, target: Path) -> None:
    content = file.read_bytes()
    if not target.is_file() or target.read_bytes() != content:
        target.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(target, content)
