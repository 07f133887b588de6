"""The parts of a job's keys, by name: what is to be told of a job that is computed again.

Two jobs of one row (task, case, fold, entrant) have the same keys if and only if they have the same
parts.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

from mocapbench.benchmark.foreign_files import (
    ForeignFileError,
    Index,
    Key,
    Name,
    read_file,
    read_json,
    table_schema,
)
from mocapbench.benchmark.tasks.address import Address

__all__ = ["DIGEST", "LIBRARIES", "KeyEntry", "encode_keys", "key_parts", "read_keys"]

KeyEntry = tuple[Address, Mapping[str, str]]
"""What is known of a key: the row that it belongs to, and its parts."""

LIBRARIES = ("numpy", "scipy", "scikit-learn")
"""The numerical libraries, whose versions every key covers."""
DIGEST = "sha256:"
"""With this begins a part that is too long to be shown or kept."""
_LONGEST = 40
_FORMAT = 1
_KEYS = table_schema(
    {
        "format": Literal[1],
        "parts": list[tuple[Name, Name]],
        "keys": dict[Key, tuple[Name, Index, Name, Index | None, Name, list[Index]]],
    }
)
"""What the file holds: of each key an address, and the numbers of its parts."""
_LARGEST = 256 * 2**20
"""Bytes, of hundreds of thousands of keys."""
_encode = json.JSONEncoder(sort_keys=True).encode
_encode_in_order = json.JSONEncoder().encode


def key_parts(fitted: Mapping[str, Any], scored: Mapping[str, Any]) -> Mapping[str, str]:
    """Return what two keys cover, each part as a short text or a digest.

    Parameters
    ----------
    fitted, scored : mapping of str to Any
        What the fit key and the score key cover; see `fit_contents` and `score_contents`.
    """
    _, version, problem, _, _, seed, digests = fitted["problem"]
    model, parameters = fitted["entrant"]
    model_code, fitting_code, calibration_code = fitted["source"]
    _, references = scored["scored against"]
    parts = {
        "task version": version,
        "problem": problem,
        "seed": seed,
        "task code": fitted["posed by"],
        "training": fitted["training"],
        "model": model,
        "model code": model_code,
        "fitting code": fitting_code,
        "calibration code": calibration_code,
        **_each("parameter", parameters),
        **_each("recording", digests),
        **_each("reference recording", references),
        **_each("version of", fitted["libraries"]),
        **_each("metric", scored["metrics"]),
    }
    return _shorten_parts(_encode_in_order(parts))


@lru_cache(maxsize=1024)  # the folds of a row have the same parts, and come one after the other
def _shorten_parts(parts: str) -> Mapping[str, str]:
    """Return the parts of a key, of which the JSON is given, each as a short text or a digest."""
    return {name: _shorten_text(_encode(value)) for name, value in json.loads(parts).items()}


def _each(kind: str, values: Mapping[str, Any]) -> dict[str, Any]:
    return {f"{kind} {name}": value for name, value in values.items()}


@lru_cache(maxsize=8192)  # most are parts of many rows, which are to hold one text
def _shorten_text(text: str) -> str:
    if len(text) <= _LONGEST:
        return text
    return DIGEST + hashlib.sha256(text.encode()).hexdigest()[:16]


def encode_keys(entries: Mapping[str, KeyEntry]) -> dict[str, Any]:
    """Return what JSON can hold of the parts of each key.

    Each part stands once, under a number: most are the same for most jobs. The order of entries
    changes nothing: a run that is resumed finds some of them written.
    """
    numbers: dict[tuple[str, str], int] = {}
    keys = {
        key: [*address, [numbers.setdefault(part, len(numbers)) for part in parts.items()]]
        for key, (address, parts) in sorted(entries.items())
    }
    return {"format": _FORMAT, "parts": list(numbers), "keys": keys}


def read_keys(path: Path) -> dict[str, KeyEntry]:
    """Return the parts of each key that a file has.

    Raises
    ------
    ForeignFileError
        If it is damaged.
    """
    return read_file(path, "a list of keys", "`mocapbench run` writes it again", _read_whole)


def _read_whole(path: Path) -> dict[str, KeyEntry]:
    document: dict[str, Any] = read_json(path, _KEYS, _LARGEST)
    parts = document["parts"]
    try:
        return {
            key: (Address(*address), dict(parts[number] for number in numbers))
            for key, (*address, numbers) in document["keys"].items()
        }
    except IndexError as error:
        said = f"expected numbers below {len(parts)}, got one beyond"
        raise ForeignFileError(said) from error
