"""Whether all entrants of a fold were posed one problem: scores of others cannot be paired.

A task that draws from anything but its seeds poses another problem to each of them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import fields, is_dataclass, replace
from itertools import chain
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.datasets import Recording

__all__ = ["PosedProblems", "digest_recording", "problem_digest"]

_ROUNDING = ("CPU", "machine", "libc", "BLAS", "python version", "numpy version", "scipy version")
"""The facts of a record that decide how the numbers of a problem are rounded."""
_FORMAT = 3
"""How digests are made; those of another format say nothing about each other."""
_of_recordings: WeakKeyDictionary[Recording, bytes] = WeakKeyDictionary()
"""Digests of recordings, which never change and are learnt from in many problems."""


def problem_digest(problem: Problem[Any]) -> str:
    """Return a digest of a problem: what is given, what is hidden and the truth.

    Parameters
    ----------
    problem : Problem
        Its numbers and texts count, and those of the dataclasses, mappings and sequences in it.
    """
    return f"{_FORMAT}:{_digest(_pieces(problem)).hex()[:16]}"


def _digest(pieces: Iterable[bytes]) -> bytes:
    digest = hashlib.sha256()
    for piece in pieces:
        digest.update(len(piece).to_bytes(8, "big"))
        digest.update(piece)
    return digest.digest()


def digest_recording(recording: Recording) -> bytes:
    """Return a digest of a recording, which is computed once."""
    if recording not in _of_recordings:
        pieces = chain.from_iterable(map(_pieces, _parts(recording)))
        _of_recordings[recording] = _digest(pieces)
    return _of_recordings[recording]


def _pieces(value: object) -> Iterator[bytes]:
    """Yield the content of a value; of an object that is not a dataclass, its class alone."""
    yield type(value).__qualname__.encode()
    match value:
        case Recording():
            yield digest_recording(value)
        case np.ndarray() if not value.dtype.hasobject:
            yield f"{value.dtype.str} {value.shape}".encode()
            yield np.ascontiguousarray(value).tobytes()
        case None | bool() | int() | float() | complex() | str() | bytes() | np.generic():
            yield repr(value).encode("utf-8", "backslashreplace")
        case _:
            parts = _parts(value)
            yield str(len(parts)).encode()
            for part in parts:
                yield from _pieces(part)


def _parts(value: object) -> tuple[object, ...]:
    match value:
        case np.ndarray():
            return (value.shape, *value.flat)
        case Mapping():
            return tuple(value.items())
        case tuple() | list():
            return tuple(value)
        case Set():
            return tuple(sorted(map(repr, value)))
        case _ if is_dataclass(value):
            return tuple((field.name, getattr(value, field.name)) for field in fields(value))
    return ()


class PosedProblems:
    """The problem of each fold, as the first record that is there has it."""

    def __init__(self) -> None:
        self._first: dict[tuple[object, ...], Record] = {}

    def check_record(self, record: Record) -> Record:
        """Return ``record``; a failed one in its place if it solves another problem than the first.

        Records without scores or a digest are not compared, nor are digests of different formats,
        as of earlier versions, and of different machines, which may round differently.
        """
        if not (record.problem and record.scores):
            return record
        problem = record.address._replace(label="")
        facts = (record.provenance.get(name, "") for name in _ROUNDING)
        made = record.problem.rpartition(":")[0]
        first = self._first.setdefault((problem, record.seed, made, *facts), record)
        if first.problem == record.problem:
            return record
        message = (
            f"expected the problem of this fold that was posed to {first.address.label}, got "
            "another, so that their scores cannot be compared: the task draws or reads something "
            "by itself; let it draw from `seeds` and read from `archive` alone, which `check_task` "
            "tests"
        )
        nothing: dict[str, Any] = {"scores": {}, "parts": {}, "left_out": {}}
        return replace(record, status=Status.FAILED, message=message, **nothing)
