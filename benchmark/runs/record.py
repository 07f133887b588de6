"""Records: the result of one job, as one immutable row."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from enum import StrEnum
from functools import lru_cache
from sys import intern
from typing import Annotated, Any, Literal, Self, get_type_hints

import msgspec
import numpy as np
from msgspec import Meta

from mocapbench.basics.words import printable
from mocapbench.benchmark.foreign_files import (
    Index,
    Key,
    Name,
    Parameter,
    Text,
    decode_json,
    encode_json,
)
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Record", "Status"]

FORMAT = 1
_Cost = Annotated[float, Meta(ge=0.0)]


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
    parts : mapping of str to mapping of str to sequence of float
        Per-output, per-frame … values by metric; kept as arrays of 8 bytes a number, for a record
        has hundreds of them.
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

    key: Key
    fit_key: Key
    address: Address
    seed: Annotated[int, Meta(ge=0)]
    model: Name
    parameters: Mapping[str, Any]
    status: Status
    message: Text = ""
    traceback: Text = ""
    scores: Mapping[str, float] = field(default_factory=dict)
    parts: Mapping[str, Mapping[str, Sequence[float]]] = field(default_factory=dict)
    left_out: Mapping[Name, Index] = field(default_factory=dict)
    fit_seconds: _Cost | None = None
    predict_seconds: _Cost | None = None
    peak_memory_mb: _Cost | None = None
    iterations: Index | None = None
    converged: bool | None = None
    engine: Text = ""
    warnings: tuple[Text, ...] = ()
    provenance: Mapping[Name, Text] = field(default_factory=dict)
    problem: Name = ""
    missing: tuple[Name, ...] = ()
    fetch: Text = ""

    def __post_init__(self) -> None:
        for name in ("message", "traceback", "engine", "fetch"):
            object.__setattr__(self, name, _plain(getattr(self, name)))
        for name in ("warnings", "missing"):
            object.__setattr__(self, name, tuple(map(_plain, getattr(self, name))))
        packed = {
            intern(metric): {intern(axis): _pack_numbers(part) for axis, part in parts.items()}
            for metric, parts in self.parts.items()
        }
        object.__setattr__(self, "parts", packed)
        object.__setattr__(self, "scores", {intern(name): v for name, v in self.scores.items()})
        object.__setattr__(self, "provenance", _share_facts(*self.provenance.items()))

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what pickles it: a record that a worker sends shares its provenance, too."""
        return type(self), tuple(getattr(self, item.name) for item in fields(self))

    @property
    def seconds(self) -> float | None:
        """How long the fit and the prediction took; None where the fit is not known."""
        return (
            None if self.fit_seconds is None else self.fit_seconds + (self.predict_seconds or 0.0)
        )

    def to_json(self) -> str:
        """Return the record as JSON; NaN becomes null, the address five entries."""
        document = {item.name: getattr(self, item.name) for item in fields(self)}
        document |= {"format": FORMAT, **document.pop("address")._asdict()}
        document["parts"] = {
            metric: {axis: list(part) for axis, part in parts.items()}
            for metric, parts in self.parts.items()
        }
        return encode_json(document).decode()

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Read a record back.

        Raises
        ------
        ForeignFileError
            If the text is not a whole record of this format.
        """
        document = msgspec.structs.asdict(decode_json(text, _Document))
        del document["format"]
        address = Address(**{name: document.pop(name) for name in Address._fields})
        scores = {name: math.nan if v is None else v for name, v in document["scores"].items()}
        return cls(address=address, **{**document, "scores": scores})


_ENTRIES = {
    "format": Literal[1],
    **{"task": Name, "version": Index, "case": Name, "fold": Index | None, "label": Name},
    **get_type_hints(Record, include_extras=True),
    "parameters": dict[Name, Parameter],
    "scores": dict[Name, float | None],
    "parts": dict[Name, dict[Name, list[float | None]]],
}
"""What a file of a record holds: null stands for NaN, and the address is five entries."""
_Document = msgspec.defstruct(
    "Record",
    [(name, schema) for name, schema in _ENTRIES.items() if name != "address"],
    forbid_unknown_fields=True,
)


def _pack_numbers(numbers: Sequence[float | None]) -> array[float]:
    """Return numbers in 8 bytes each; None is NaN."""
    return array("d", np.asarray(numbers, dtype=np.float64).tobytes())


@lru_cache
def _share_facts(*facts: tuple[str, str]) -> Mapping[str, str]:
    """Return the one mapping of these entries, which most records of a run have in common."""
    return dict(facts)


def _plain(text: str) -> str:
    """Return ``text`` without what no file, no terminal and no spreadsheet would show."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n")
    return printable(lines)
