"""The store: one file per record and one per fit, each written whole or not at all.

::

    run-directory/
        mocapbench.json             says that the folder is ours
        mocapbench.lock             held by a run that writes
        plan.json                   the keys of the last run, in table order, and what they name
        keys.json                   what the keys of records cover, part by part
        check.json                  what the last regression check of that run found
        records/ab/<score key>.json
        predictions/ab/<fit key>.npz

The folders between are named by the first two digits of the keys, so that none gets slow to list;
earlier versions wrote without them, which is read too. Resuming skips what exists. A truncated or
foreign file is reported in `Store.damaged` and treated as absent.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import atomic_write, words_of
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.directory.key_file import KEYS, KeyEntry, read_keys, write_keys
from mocapbench.benchmark.runs.directory.leftovers import sweep
from mocapbench.benchmark.runs.directory.lock import held, is_held
from mocapbench.benchmark.runs.directory.plan_file import load_plan, save_plan
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.record import Record, RecordError

__all__ = ["Store"]

T = TypeVar("T")

_MARKER = "mocapbench.json"
_CHECK = "check.json"
_FORMAT = 1
_UNREADABLE = (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile)
"""What reading damaged predictions raises."""


class Store:
    """A run directory.

    Parameters
    ----------
    path : Path
        An existing run directory; see `create` and `open`.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damaged: list[str] = []

    @classmethod
    def create(cls, path: Path) -> Store:
        """Return the store at ``path``, which is made if it is new or empty.

        Raises
        ------
        UsageError
            If the folder holds other things, or cannot be written.
        """
        cls.require_usable(path)
        try:
            for folder in ("records", "predictions"):
                (path / folder).mkdir(parents=True, exist_ok=True)
            if not (path / _MARKER).is_file():
                with atomic_write(path / _MARKER) as file:
                    file.write(json.dumps({"format": _FORMAT}).encode())
        except OSError as error:
            raise UsageError(
                f"--out: expected a folder that can be written to, got {path} ({words_of(error)}); "
                "name another, or change its permissions"
            ) from error
        return cls(path)

    @classmethod
    def open(cls, path: Path) -> Store:
        """Return the store at ``path``, which must exist.

        Raises
        ------
        UsageError
            If it is not a run directory.
        """
        if not cls.is_run(path):
            raise UsageError(
                f"{path} is not a mocapbench run (there is no {_MARKER} in it); "
                "name the folder that `mocapbench run --out` wrote"
            )
        return cls(path)

    @staticmethod
    def require_usable(path: Path) -> None:
        """Refuse a folder of other things.

        Raises
        ------
        UsageError
            If ``path`` is a file, or a folder that holds anything but a run.
        """
        if path.exists() and not path.is_dir():
            raise UsageError(f"--out: expected a folder, got the file {path}; name another folder")
        if path.is_dir() and any(path.iterdir()) and not (path / _MARKER).is_file():
            raise UsageError(
                f"--out: {path} holds files that are not a mocapbench run (there is no {_MARKER} "
                "in it); name a new or empty folder"
            )

    @staticmethod
    def is_run(path: Path) -> bool:
        """Return whether ``path`` is a run directory."""
        return (path / _MARKER).is_file()

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Keep other runs out of the folder.

        Raises
        ------
        UsageError
            If another run is in it.
        """
        with held(self.path):
            yield

    @property
    def is_locked(self) -> bool:
        """Whether a run is writing to the folder now."""
        return is_held(self.path)

    def sweep(self) -> None:
        """Delete temporary files that a killed run left; only for who has locked the folder."""
        sweep(self.path)

    def load(self, key: str) -> Record | None:
        """Return the record called ``key``, or None if it is absent or damaged."""
        path = self.record_path(key)
        if not path.is_file():
            return None
        try:
            record = Record.from_json(path.read_bytes())
            if record.key != key:
                raise RecordError(f"it holds the record {record.key}")
        except (OSError, RecordError) as error:
            self.damaged.append(f"{path}: {error}")
            return None
        return replace(
            record,
            scores=_renamed(record.scores),
            parts=_renamed(record.parts),
            left_out=_renamed(record.left_out),
        )

    def save(self, record: Record) -> None:
        """Write ``record`` whole or not at all."""
        with atomic_write(_made(self._record_path(record.key))) as file:
            file.write(record.to_json().encode())

    def records(self) -> list[Record]:
        """Return every whole record, by name of file."""
        keys = sorted(self.record_keys())
        return [record for key in keys if (record := self.load(key)) is not None]

    def record_keys(self) -> set[str]:
        """Return the keys under which there are records, whole or damaged."""
        return {path.stem for path in (self.path / "records").rglob("[!.]*.json")}

    def fit_keys(self) -> set[str]:
        """Return the keys under which there are predictions, whole or damaged."""
        return {path.stem for path in (self.path / "predictions").rglob("[!.]*.npz")}

    def planned(self) -> list[Record]:
        """Return the whole records of the last run, in table order.

        Raises
        ------
        UsageError
            If no run got so far, or its plan is damaged.
        """
        keys = self.load_plan()["keys"]
        return [record for key in keys if (record := self.load(key)) is not None]

    def load_fit(self, key: str) -> Fit | None:
        """Return the fit called ``key``, or None if it is absent or damaged."""
        return self._read_fit(key, _whole_fit)

    def has_fit(self, key: str) -> bool:
        """Return whether there are predictions called ``key``, as far as a glance can tell."""
        return self._read_fit(key, _about) is not None

    def _read_fit(self, key: str, read: Callable[[Any, str], T]) -> T | None:
        path = self.fit_path(key)
        if not path.is_file():
            return None
        try:
            with np.load(path, allow_pickle=False) as arrays:
                return read(arrays, key)
        except _UNREADABLE as error:
            self.damaged.append(f"{path}: not a whole set of predictions: {error}")
            return None

    def save_fit(self, key: str, fit: Fit) -> None:
        """Write ``fit`` whole or not at all.

        It is not compressed: of such numbers that would save a quarter of the bytes, and take
        longer than all else that a run does itself with a job.
        """
        about = {**fit.costs, "key": key}
        with atomic_write(_made(self._fit_path(key))) as file:
            arrays: dict[str, Any] = {**fit.arrays, "about": np.array(json.dumps(about))}
            np.savez(file, **arrays)

    def save_plan(self, plan: Mapping[str, Any]) -> None:
        """Write what the last run was asked to do; a check of an earlier one is dropped."""
        (self.path / _CHECK).unlink(missing_ok=True)
        save_plan(self.path, plan)

    def load_plan(self) -> Mapping[str, Any]:
        """Return what the last run was asked to do.

        Raises
        ------
        UsageError
            If no run got so far, or the file is damaged.
        """
        return load_plan(self.path)

    def keep_keys(self, entries: Mapping[str, KeyEntry]) -> None:
        """Keep what the keys of ``entries`` cover, beside those of the records that are here."""
        written = self.record_keys()
        known = {key: entry for key, entry in self.load_keys().items() if key in written}
        write_keys(self.path / KEYS, {**known, **entries})

    def load_keys(self) -> dict[str, KeyEntry]:
        """Return what the keys of records cover, as far as it was kept."""
        path = self.path / KEYS
        try:
            return read_keys(path) if path.is_file() else {}
        except (OSError, ValueError) as error:
            self.damaged.append(f"{path}: {error}")
            return {}

    def save_check(self, check: Mapping[str, Any]) -> None:
        """Write what a regression check of the last run found."""
        with atomic_write(self.path / _CHECK) as file:
            file.write(json.dumps(check, indent=1).encode())

    def load_check(self) -> Mapping[str, Any] | None:
        """Return what the last run's check found; None if it was not checked, or is damaged."""
        path = self.path / _CHECK
        if not path.is_file():
            return None
        try:
            check = dict(json.loads(path.read_text(encoding="utf-8")))
            if check.keys() != {"reference", "summary", "passed", "findings"}:
                raise ValueError(f"it holds {sorted(check)}")
            return check
        except (OSError, ValueError, TypeError) as error:
            self.damaged.append(f"{path}: not a whole check: {error}")
            return None

    def record_path(self, key: str) -> Path:
        """Return where the record called ``key`` is, or belongs."""
        return _there(self._record_path(key))

    def fit_path(self, key: str) -> Path:
        """Return where the predictions called ``key`` are, or belong."""
        return _there(self._fit_path(key))

    def _record_path(self, key: str) -> Path:
        return self.path / "records" / key[:2] / f"{key}.json"

    def _fit_path(self, key: str) -> Path:
        return self.path / "predictions" / key[:2] / f"{key}.npz"


def _about(arrays: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Return what predictions say of themselves, which must be those called ``key``."""
    about: dict[str, Any] = json.loads(str(arrays["about"]))
    if about.pop("key") != key:
        raise ValueError("it holds those of another job")
    return about


def _whole_fit(arrays: Mapping[str, Any], key: str) -> Fit:
    about = _about(arrays, key)
    contents = {name: array for name, array in arrays.items() if name != "about"}
    return Fit(contents, **{**about, "warnings": tuple(about["warnings"])})


def _made(path: Path) -> Path:
    """Return ``path``, whose folder is there from now on."""
    path.parent.mkdir(exist_ok=True)
    return path


def _there(path: Path) -> Path:
    """Return where a file is: earlier versions put it one folder higher."""
    flat = path.parents[1] / path.name
    return path if path.is_file() or not flat.is_file() else flat


def _renamed(by_metric: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``by_metric`` under today's names: earlier versions wrote former ones."""
    return {METRICS.renamed(name): value for name, value in by_metric.items()}
