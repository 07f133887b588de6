"""What is new in a key, part by part and in words."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from itertools import chain
from typing import NamedTuple

from mocapbench.benchmark.runs.key_parts import DIGEST

__all__ = ["Change", "changes", "in_words"]

_KINDS = ("metric", "parameter", "recording", "reference recording")
"""Of which a key may have many."""
_MANY = 3
"""Changes of one kind beyond which they are counted."""


class Change(NamedTuple):
    """A part of a key that is not as it was; empty where there is none."""

    part: str
    before: str
    after: str

    @property
    def verb(self) -> str:
        """What happened to the part, unless its value is all that changed."""
        match self.before, self.after:
            case "", _:
                return " added"
            case _, "":
                return " left out"
            case _:
                return ""

    def __str__(self) -> str:
        values = [value for value in (self.before, self.after) if value]
        if any(value.startswith(DIGEST) for value in values):
            return f"{self.part}{self.verb}"
        return f"{self.part}{self.verb} {' → '.join(values)}"


def changes(before: Mapping[str, str], after: Mapping[str, str]) -> tuple[Change, ...]:
    """Return what differs between the parts of two keys, by name."""
    return tuple(
        Change(name, before.get(name, ""), after.get(name, ""))
        for name in {**before, **after}
        if before.get(name) != after.get(name)
    )


def in_words(several: Iterable[Change]) -> str:
    """Return changes in words; many alike are counted."""
    alike: dict[tuple[str, str], list[Change]] = defaultdict(list)
    for change in several:
        alike[_kind(change), change.verb].append(change)
    texts = (
        [f"{len(group)} {kind}s{verb}"] if len(group) > _MANY else map(str, group)
        for (kind, verb), group in alike.items()
    )
    return ", ".join(chain.from_iterable(texts))


def _kind(change: Change) -> str:
    """Return of what kind a part is: the part of one metric is called ``metric NAME``."""
    return next((kind for kind in _KINDS if change.part.startswith(f"{kind} ")), change.part)
