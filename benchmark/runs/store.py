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

The modules of ``directory`` read and write these files. Resuming skips what exists. A truncated or
foreign file is reported in `Store.damaged` and treated as absent.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import words_of
from mocapbench.benchmark.runs.directory import marker
from mocapbench.benchmark.runs.directory.check_file import CHECK, read_check, write_check
from mocapbench.benchmark.runs.directory.fit_files import PREDICTIONS, FitFiles
from mocapbench.benchmark.runs.directory.key_file import KEYS, KeyEntry, read_keys, write_keys
from mocapbench.benchmark.runs.directory.leftovers import sweep
from mocapbench.benchmark.runs.directory.lock import held, is_held
from mocapbench.benchmark.runs.directory.plan_file import load_plan, save_plan
from mocapbench.benchmark.runs.directory.record_files import RECORDS, RecordFiles
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.record import Record

__all__ = ["Store"]


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
        self._records = RecordFiles(path, self.damaged)
        self._fits = FitFiles(path, self.damaged)

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
            for folder in (RECORDS, PREDICTIONS):
                (path / folder).mkdir(parents=True, exist_ok=True)
            marker.mark(path)
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
        marker.require_run(path)
        return cls(path)

    @staticmethod
    def require_usable(path: Path) -> None:
        """Refuse a file, or a folder that holds anything but a run, by a `UsageError`."""
        marker.require_usable(path)

    @staticmethod
    def is_run(path: Path) -> bool:
        """Return whether ``path`` is a run directory."""
        return marker.is_run(path)

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
        return self._records.load(key)

    def save(self, record: Record) -> None:
        """Write ``record`` whole or not at all."""
        self._records.save(record)

    def records(self) -> list[Record]:
        """Return every whole record, by name of file."""
        return self._whole(sorted(self.record_keys()))

    def planned(self) -> list[Record]:
        """Return the whole records of the last run, in table order.

        Raises
        ------
        UsageError
            If no run got so far, or its plan is damaged.
        """
        return self._whole(self.load_plan()["keys"])

    def _whole(self, keys: Iterable[str]) -> list[Record]:
        return [record for key in keys if (record := self.load(key)) is not None]

    def record_keys(self) -> set[str]:
        """Return the keys under which there are records, whole or damaged."""
        return self._records.files.keys()

    def record_path(self, key: str) -> Path:
        """Return where the record called ``key`` is, or belongs."""
        return self._records.files.find(key)

    def load_fit(self, key: str) -> Fit | None:
        """Return the fit called ``key``, or None if it is absent or damaged."""
        return self._fits.load(key)

    def has_fit(self, key: str) -> bool:
        """Return whether there are predictions called ``key``, as far as a glance can tell."""
        return self._fits.has(key)

    def save_fit(self, key: str, fit: Fit) -> None:
        """Write ``fit`` whole or not at all."""
        self._fits.save(key, fit)

    def fit_keys(self) -> set[str]:
        """Return the keys under which there are predictions, whole or damaged."""
        return self._fits.files.keys()

    def fit_path(self, key: str) -> Path:
        """Return where the predictions called ``key`` are, or belong."""
        return self._fits.files.find(key)

    def save_plan(self, plan: Mapping[str, Any]) -> None:
        """Write what the last run was asked to do; a check of an earlier one is dropped."""
        (self.path / CHECK).unlink(missing_ok=True)
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
        write_check(self.path / CHECK, check)

    def load_check(self) -> Mapping[str, Any] | None:
        """Return what the last run's check found; None if it was not checked, or is damaged."""
        path = self.path / CHECK
        try:
            return read_check(path) if path.is_file() else None
        except (OSError, ValueError) as error:
            self.damaged.append(f"{path}: not a whole check: {error}")
            return None
