"""The parts of a docstring, as reStructuredText for a page."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from numpydoc.docscrape import ClassDoc, FunctionDoc, NumpyDocString

from mocapbench import baselines

__all__ = ["Described", "Setting", "api_name", "described_class", "described_function"]

_PAGE = re.compile(r"``docs/([\w/-]+)\.md``|\(docs/([\w/-]+)\.md\)")
_MENTION = re.compile(r"(?<![`:\w])`([\w.]+)`(?!`)")
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
    """Return what the docstring of a class says; what it names is linked to the API section."""
    parts = _parts(ClassDoc(described, config={"show_class_members": False}))
    linked = partial(_MENTION.sub, partial(_mentioned, described))
    settings = tuple(replace(each, meaning=linked(each.meaning)) for each in parts.settings)
    texts = {name: linked(getattr(parts, name)) for name in ("idea", "formula", "references")}
    return replace(parts, settings=settings, **texts)


def api_name(described: type) -> str:
    """Return the name of a model in the API section; empty for a model of others."""
    name = described.__name__
    return name if getattr(baselines, name, None) is described else ""


def _mentioned(described: type, match: re.Match[str]) -> str:
    """Return a link to a member of the class; the API section has no others' classes."""
    if not api_name(described):
        return f"``{match[1]}``"
    return f"`~{described.__name__}.{match[1]}`" if hasattr(described, match[1]) else match[0]


def described_function(described: Any) -> Described:
    """Return what the docstring of a function says of what it returns.

    Parameters
    ----------
    described : callable
    """
    parts = _parts(FunctionDoc(described))
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
