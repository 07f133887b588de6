"""Records: the result of one job, as one immutable row."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from enum import StrEnum
from typing import Any, Self

import orjson

from mocapbench.basics.words import encodable, printable
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Record", "RecordError", "Status"]

FORMAT = 1


class Status(StrEnum):
    """How a job ended."""

    OK = "ok"
    FAILED = "failed"
    TIMEOUT = "timeout"
    OUT_OF_MEMORY = "out-of-memory"
    DATA_MISSING = "data-missing"

    @property
    def broken(self) -> bool:
        """Whether something went wrong that the user should look at."""
        return self in {Status.FAILED, Status.TIMEOUT, Status.OUT_OF_MEMORY}


class RecordError(ValueError):
    """A file that does not hold a record."""


@dataclass(frozen=True)
class Record:
    """One row per (task, case, fold, entrant).

    Parameters
    ----------
    key, fit_key : str
        The score key, which names the record, and the fit key, which names its predictions.
    address : Address
        The case, the fold and the entrant.
    seed : int
        The root seed of the run.
    model, parameters : str, mapping
        What the entrant is.
    status, message, traceback : Status, str, str
        How it ended, and why; texts are kept without control characters.
    scores : mapping of str to float
        Metric values; NaN where the metric is not defined.
    parts : mapping of str to mapping of str to list of float
        Per-output, per-frame … values by metric.
    left_out : mapping of str to int
        Degenerate outputs left out, by metric.
    fit_seconds, predict_seconds, peak_memory_mb : float or None
    iterations, converged : int or None, bool or None
        Of the optimisation, where the model has one.
    engine : str
        By what algorithm the model computed and why, where it says so.
    warnings : tuple of str
        Warnings that the model or the data raised.
    provenance : mapping of str to str
        Versions, commit, CPU, threads, data digests, command line.
    problem : str
        Digest of the problem that was posed; empty where there are no scores.
    missing, fetch : tuple of str, str
        Recordings that the job lacked, and the command that gets them, up to their names.
    """

    key: str
    fit_key: str
    address: Address
    seed: int
    model: str
    parameters: Mapping[str, Any]
    status: Status
    message: str = ""
    traceback: str = ""
    scores: Mapping[str, float] = field(default_factory=dict)
    parts: Mapping[str, Mapping[str, list[float]]] = field(default_factory=dict)
    left_out: Mapping[str, int] = field(default_factory=dict)
    fit_seconds: float | None = None
    predict_seconds: float | None = None
    peak_memory_mb: float | None = None
    iterations: int | None = None
    converged: bool | None = None
    engine: str = ""
    warnings: tuple[str, ...] = ()
    provenance: Mapping[str, str] = field(default_factory=dict)
    problem: str = ""
    missing: tuple[str, ...] = ()
    fetch: str = ""

    def __post_init__(self) -> None:
        for name in ("message", "traceback", "engine", "fetch"):
            object.__setattr__(self, name, _plain(getattr(self, name)))
        for name in ("warnings", "missing"):
            object.__setattr__(self, name, tuple(map(_plain, getattr(self, name))))

    def to_json(self) -> str:
        """Return the record as strict JSON; NaN becomes null, the address five entries."""
        document = {item.name: getattr(self, item.name) for item in fields(self)}
        document |= {"format": FORMAT, **document.pop("address")._asdict()}
        try:
            return orjson.dumps(document).decode()
        except TypeError:  # integers of more than 64 bits, surrogates, keys that are not text
            return json.dumps(_without_nan(document))

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Read a record back.

        Raises
        ------
        RecordError
            If the text is not a whole record of this format.
        """
        try:
            document = _parse_json(text)
            if document.pop("format") != FORMAT:
                raise RecordError("the record has another format")
            document["status"] = Status(document["status"])
            document |= {name: tuple(document[name]) for name in ("warnings", "missing")}
            document["scores"] = {
                name: math.nan if value is None else float(value)
                for name, value in document["scores"].items()
            }
            missing = _ENTRIES ^ set(document)
            if missing:
                raise RecordError(f"fields missing or unknown: {sorted(missing)}")
            address = Address(**{name: document.pop(name) for name in Address._fields})
            return cls(address=address, **document)
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise RecordError(f"not a whole record: {error}") from error


_ENTRIES = {*Address._fields, *(item.name for item in fields(Record))} - {"address"}


_LONG = re.compile(rb"(?<![0-9.])[0-9]{19}")
"""An integer that may need more than 64 bits; not the digits behind a point."""


def _parse_json(text: str | bytes) -> Any:
    """Return what a JSON text says; integers of any length stay whole, which orjson rounds."""
    data = text.encode() if isinstance(text, str) else text
    return json.loads(data) if _LONG.search(data) else orjson.loads(data)


def _plain(text: str) -> str:
    """Return ``text`` without what no file, no terminal and no spreadsheet would show."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n")
    return printable(lines)


def _without_nan(value: Any) -> Any:
    match value:
        case dict():
            return {encodable(str(key)): _without_nan(item) for key, item in value.items()}
        case list() | tuple():
            return [_without_nan(item) for item in value]
        case str():
            return encodable(value)
        case float() if not math.isfinite(value):
            return None
        case _:
            return value
