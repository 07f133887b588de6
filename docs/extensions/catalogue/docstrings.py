"""The parts of a docstring, as reStructuredText for a page."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from numpydoc.docscrape import ClassDoc, FunctionDoc, NumpyDocString

__all__ = ["Described", "Setting", "described_class", "described_function"]

_PAGE = re.compile(r"``docs/([\w-]+)\.md``|\(docs/([\w-]+)\.md\)")
_DOCS = Path(__file__).parents[2]


@dataclass(frozen=True)
class Setting:
    """One parameter of a model: its name, its type with the default, and what it means."""

    name: str
    kind: str
    meaning: str


@dataclass(frozen=True)
class Described:
    """What a docstring says; parts that it lacks are empty.

    Parameters
    ----------
    idea : str
        The first line and the paragraphs after it.
    formula, pitfalls, references, example : str
        The sections "Notes", "Warnings", "References" and "Examples".
    settings : tuple of Setting
    """

    idea: str
    formula: str
    pitfalls: str
    references: str
    example: str
    settings: tuple[Setting, ...]


def described_class(described: type) -> Described:
    """Return what the docstring of a class says."""
    return _parts(ClassDoc(described, config={"show_class_members": False}))


def described_function(described: Any) -> Described:
    """Return what the docstring of a function says of what it returns.

    Parameters
    ----------
    described : callable
        Arguments may be bound to it.
    """
    parts = _parts(FunctionDoc(getattr(described, "func", described)))
    returned = parts.idea.removeprefix("Return ")
    return replace(parts, idea=returned[:1].upper() + returned[1:])


def _parts(doc: NumpyDocString) -> Described:
    return Described(
        idea=_text([*doc["Summary"], "", *doc["Extended Summary"]]),
        formula=_text(doc["Notes"]),
        pitfalls=_text(doc["Warnings"]),
        references=_text(doc["References"]),
        example=_text(doc["Examples"]),
        settings=tuple(Setting(p.name, p.type, _text(p.desc)) for p in doc["Parameters"]),
    )


def _text(lines: list[str]) -> str:
    """Return the lines as one text, in which the names of pages are links."""
    return _PAGE.sub(_linked, "\n".join(lines).strip())


def _linked(match: re.Match[str]) -> str:
    name = match[1] or match[2]
    if not (_DOCS / f"{name}.md").exists():
        return match[0]
    return f":doc:`/{name}`" if match[1] else f"(:doc:`/{name}`)"
