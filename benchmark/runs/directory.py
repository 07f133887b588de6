"""A run directory: one file per record and one per fit, each written whole or not at all.

::

    run-directory/
        mocapbench.json             says that the folder is ours, and of which layout
        mocapbench.lock             held by a run that writes
        plan.json                   the keys of the last run, in table order, and what they name
        keys.json                   what the keys of records cover, part by part
        check.json                  what the last regression check of that run found
        records/ab/<score key>.json
        predictions/ab/<fit key>.npz

Folders named by the first two digits of the keys keep each of them quick to list. Resuming skips
what exists. A truncated or foreign file is reported in `RunDirectory.damaged` and treated as
absent.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import msgspec
import numpy as np
from filelock import FileLock, Timeout

from mocapbench.basics.array_archives import open_arrays
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.temporaries import sweep
from mocapbench.basics.whole_files import atomic_write, write_text
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import words_of
from mocapbench.benchmark.foreign_files import (
    ForeignFileError,
    Key,
    decode_json,
    encode_json,
    read_bytes,
    read_file,
    read_json,
)
from mocapbench.benchmark.runs.check_document import read_check
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.key_parts import KeyEntry, encode_keys, read_keys
from mocapbench.benchmark.runs.plan_document import PlannedJob, planned_jobs, read_plan
from mocapbench.benchmark.runs.record import Record

__all__ = ["RunDirectory"]

T = TypeVar("T")

_MARKER, _LOCK = "mocapbench.json", "mocapbench.lock"
_PLAN, _KEYS, _CHECK = "plan.json", "keys.json", "check.json"
_RECORDS, _PREDICTIONS = "records", "predictions"
_LAYOUT = 2
"""Counts the layouts that developers have seen; a folder of another one is refused."""

_PATIENCE = 0.2
"""Seconds; whoever only looks whether the lock is held has it for a moment."""
_ABOUT = msgspec.defstruct(
    "_ABOUT",
    [("key", Key), *((n, kind) for n, kind in get_type_hints(Fit).items() if n != "arrays")],
)
"""What predictions say of themselves."""


class RunDirectory:
    """A run directory that is there; ``create`` makes one.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    damaged : list of str
        A message for every file that was found truncated or foreign.

    Raises
    ------
    UsageError
        If ``path`` is not a run directory, or one of another layout.
    """

    def __init__(self, path: Path) -> None:
        if not self.is_run(path):
            raise UsageError(
                f"{path} is not a mocapbench run (there is no {_MARKER} in it); "
                "name the folder that `mocapbench run --out` wrote"
            )
        _require_layout(path)
        self.path = path
        self.damaged: list[str] = []

    @classmethod
    def create(cls, path: Path) -> RunDirectory:
        """Return the run directory at ``path``, which is made if it is new or empty.

        Raises
        ------
        UsageError
            If the folder holds other things or a run of another layout, or cannot be written.
        """
        cls.require_usable(path)
        try:
            if not cls.is_run(path):
                path.mkdir(parents=True, exist_ok=True)
                write_text(path / _MARKER, json.dumps({"format": _LAYOUT}))
        except OSError as error:
            raise UsageError(
                f"--out: expected a folder that can be written to, got {path} ({words_of(error)}); "
                "name another, or change its permissions"
            ) from error
        return cls(path)

    @classmethod
    def require_usable(cls, path: Path) -> None:
        """Refuse what no run can be written to.

        Raises
        ------
        UsageError
            If ``path`` is a file, or a folder that holds anything but a run of this layout.
        """
        if path.exists() and not path.is_dir():
            raise UsageError(f"--out: expected a folder, got the file {path}; name another folder")
        sweep(path)
        if cls.is_run(path):
            _require_layout(path)
        elif path.is_dir() and any(path.iterdir()):
            raise UsageError(
                f"--out: {path} holds files that are not a mocapbench run (there is no {_MARKER} "
                "in it); name a new or empty folder"
            )

    @staticmethod
    def is_run(path: Path) -> bool:
        """Return whether ``path`` is a run directory, of whatever layout."""
        return (path / _MARKER).is_file()

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other runs out of the folder.

        Raises
        ------
        UsageError
            If another run is in it.
        """
        lock = FileLock(self.path / _LOCK, timeout=_PATIENCE)
        try:
            lock.acquire()
        except Timeout as error:
            raise UsageError(
                f"--out: another run is writing to {self.path}; wait for it or name another folder "
                "(`mocapbench merge` unites the two later)"
            ) from error
        try:
            yield
        finally:
            lock.release()

    @property
    def is_locked(self) -> bool:
        """Whether a run is writing to the folder, which need not be writable."""
        return find_system().is_held(self.path / _LOCK)

    def sweep(self) -> None:
        """Delete temporary files that killed commands left, here and where records lie."""
        for folder in (
            self.path,
            *self.path.glob(f"{_RECORDS}/*"),
            *self.path.glob(f"{_PREDICTIONS}/*"),
        ):
            sweep(folder)

    def load(self, key: str) -> Record | None:
        """Return the record called ``key``, or None if it is absent or damaged."""
        return self._read_if_whole(self.record_path(key), _read_record)

    def save(self, record: Record) -> None:
        """Write ``record`` whole or not at all."""
        write_text(_make_room(self.record_path(record.key)), record.to_json())

    def records(self) -> list[Record]:
        """Return every whole record, by name of file."""
        loaded = map(self.load, sorted(self.record_keys()))
        return [record for record in loaded if record is not None]

    def planned(self) -> list[Record]:
        """Return the whole records of the last run, in table order.

        Raises
        ------
        UsageError
            If no run got so far, or its plan is damaged.
        """
        jobs = planned_jobs(self.load_plan())
        loaded = ((job, self.load(job.key)) for job in jobs)
        return [r for job, r in loaded if r is not None and self._is_record_of(job, r)]

    def _is_record_of(self, job: PlannedJob, record: Record) -> bool:
        """Return whether a record is of the row that the plan says; one of another is damaged."""
        if record.address == job.address:
            return True
        path = self.record_path(job.key)
        self.damaged.append(f"{path}: expected the record of {job.address}, got {record.address}")
        return False

    def record_keys(self) -> set[str]:
        """Return the keys under which there are records, whole or damaged."""
        return {path.stem for path in (self.path / _RECORDS).glob("*/[!.]*.json")}

    def record_path(self, key: str) -> Path:
        """Return where the record called ``key`` is, or belongs."""
        return self.path / _RECORDS / key[:2] / f"{key}.json"

    def load_fit(self, key: str) -> Fit | None:
        """Return the fit called ``key``, or None if it is absent or damaged."""
        return self._read_fit(key, _read_whole)

    def has_fit(self, key: str) -> bool:
        """Return whether there are predictions called ``key``, as far as a glance can tell."""
        return self._read_fit(key, _read_about) is not None

    def _read_fit(self, key: str, read: Callable[[Any, str], T]) -> T | None:
        path = self.fit_path(key)
        if not path.is_file():
            return None
        try:
            with open_arrays(path) as arrays:
                assert arrays.zip is not None  # as it is once closed
                _require_stored(arrays.zip, path)
                return read(arrays, key)
        except Exception as error:  # NumPy and zipfile do not say what a damaged file raises
            self.damaged.append(f"{path}: not a whole set of predictions: {error}")
            return None

    def save_fit(self, key: str, fit: Fit) -> None:
        """Write ``fit`` whole or not at all.

        It is not compressed: of such numbers that would save a quarter of the bytes, and take
        longer than all else that a run does itself with a job.
        """
        about = {**fit.costs, "key": key}
        with atomic_write(_make_room(self.fit_path(key))) as file:
            arrays: dict[str, Any] = {**fit.arrays, "about": np.array(encode_json(about).decode())}
            np.savez(file, **arrays)

    def fit_keys(self) -> set[str]:
        """Return the keys under which there are predictions, whole or damaged."""
        return {path.stem for path in (self.path / _PREDICTIONS).glob("*/[!.]*.npz")}

    def fit_path(self, key: str) -> Path:
        """Return where the predictions called ``key`` are, or belong."""
        return self.path / _PREDICTIONS / key[:2] / f"{key}.npz"

    def save_plan(self, plan: Mapping[str, Any]) -> None:
        """Write what the last run was asked to do; a check of an earlier one is dropped."""
        (self.path / _CHECK).unlink(missing_ok=True)
        write_text(self.path / _PLAN, _in_lines(plan))

    def load_plan(self) -> Mapping[str, Any]:
        """Return what the last run was asked to do.

        Raises
        ------
        UsageError
            If no run got so far, or the file is damaged.
        """
        return read_plan(self.path / _PLAN)

    def keep_keys(self, entries: Mapping[str, KeyEntry]) -> None:
        """Keep what the keys of ``entries`` cover, beside those of the records that are here."""
        written = self.record_keys()
        known = {key: entry for key, entry in self.load_keys().items() if key in written}
        write_text(self.path / _KEYS, encode_json(encode_keys({**known, **entries})).decode())

    def load_keys(self) -> dict[str, KeyEntry]:
        """Return what the keys of records cover, as far as it was kept."""
        return self._read_if_whole(self.path / _KEYS, read_keys) or {}

    def save_check(self, check: Mapping[str, Any]) -> None:
        """Write what a regression check of the last run found."""
        write_text(self.path / _CHECK, _in_lines(check))

    def load_check(self) -> Mapping[str, Any] | None:
        """Return what the last run's check found; None if it was not checked, or is damaged."""
        return self._read_if_whole(self.path / _CHECK, read_check)

    def _read_if_whole(self, path: Path, read: Callable[[Path], T]) -> T | None:
        """Return what a file says; None if it is absent or damaged."""
        if not path.is_file():
            return None
        try:
            return read(path)
        except ForeignFileError as error:
            self.damaged.append(str(error))
            return None


def _require_layout(path: Path) -> None:
    """Refuse a run directory that another version of this code has laid out."""
    found: dict[str, int] | None
    try:
        found = read_json(path / _MARKER, dict[Key, int])
    except ForeignFileError:
        found = None
    if found != {"format": _LAYOUT}:
        raise UsageError(
            f"{path} is a run directory of another version of mocapbench: expected "
            f"{json.dumps({'format': _LAYOUT})} in its {_MARKER}, got {json.dumps(found)}; "
            "name a new folder and run `mocapbench run` again"
        )


def _make_room(path: Path) -> Path:
    """Return ``path``, once its folder is there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _read_record(path: Path) -> Record:
    """Return the record in a file, which must be named by its key."""
    return read_file(path, "a record", "`mocapbench run` computes it again", _read_same_key)


def _read_same_key(path: Path) -> Record:
    record = Record.from_json(read_bytes(path))
    if record.key != path.stem:
        raise ForeignFileError(f"it holds the record {record.key}")
    return record


def _in_lines(document: Mapping[str, Any]) -> str:
    """Return JSON that people can read and compare."""
    return msgspec.json.format(encode_json(document), indent=1).decode()


def _require_stored(archive: zipfile.ZipFile, path: Path) -> None:
    """Refuse predictions that unpack to more than their file, which could be anything."""
    if sum(member.file_size for member in archive.infolist()) > path.stat().st_size:
        raise ValueError("it unpacks to more than it is")


def _read_about(arrays: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Return what predictions say of themselves, which must be those called ``key``."""
    about = msgspec.structs.asdict(decode_json(str(arrays["about"]), _ABOUT))
    if about.pop("key") != key:
        raise ValueError("it holds those of another job")
    return about


def _read_whole(arrays: Mapping[str, Any], key: str) -> Fit:
    about = _read_about(arrays, key)
    contents = {name: array for name, array in arrays.items() if name != "about"}
    return Fit(contents, **about)
