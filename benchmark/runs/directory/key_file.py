"""The parts of the keys of a run directory's records, by which a new key is explained.

One JSON file for all of them, in which each part stands once: most are the same for most jobs.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.tasks.address import Address

__all__ = ["KEYS", "KeyEntry", "read_keys", "write_keys"]

KEYS = "keys.json"
_FORMAT = 1


class KeyEntry(NamedTuple):
    """What is known of one key."""

    address: Address
    parts: Mapping[str, str]


def write_keys(path: Path, entries: Mapping[str, KeyEntry]) -> None:
    """Write the parts of each key whole or not at all."""
    numbers: dict[tuple[str, str], int] = {}
    keys = {
        key: [*entry.address, [numbers.setdefault(part, len(numbers)) for part in parts.items()]]
        for key, entry in entries.items()
        for parts in [entry.parts]
    }
    document = {"format": _FORMAT, "parts": list(numbers), "keys": keys}
    write_text(path, json.dumps(document))


def read_keys(path: Path) -> dict[str, KeyEntry]:
    """Return the parts of each key.

    Raises
    ------
    ValueError
        If the file does not hold them.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        if document["format"] != _FORMAT:
            raise ValueError(f"it has the format {document['format']}")
        parts = [(str(name), str(text)) for name, text in document["parts"]]
        return {
            key: KeyEntry(Address(*address), dict(parts[number] for number in numbers))
            for key, (*address, numbers) in document["keys"].items()
        }
    except (KeyError, TypeError, IndexError, AttributeError) as error:
        raise ValueError(f"it is not a list of keys ({type(error).__name__}: {error})") from error
