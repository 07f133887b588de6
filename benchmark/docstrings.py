"""What a docstring says of a class: its first sentence, and the papers that it is from."""

from __future__ import annotations

import inspect
import re

__all__ = ["source", "summary"]

OURS = "this project"

_ROLE = re.compile(r":[\w:]+:(?=`)")
_REFERENCES = re.compile(r"^References\n-+\n(.*?)(?=\n\n[^\n]+\n-+\n|\Z)", re.DOTALL | re.MULTILINE)
_AUTHORS_AND_YEAR = re.compile(r"([^()]+) \((\d{4})\)")
_BETWEEN_AUTHORS = re.compile(r", | and ")
_INITIALS = re.compile(r"^(?:\S+\. )+")
_FEW = 2


def summary(described: type) -> str:
    """Return the first line of the docstring, without markup; empty where there is none."""
    first, _, _ = inspect.cleandoc(described.__doc__ or "").partition("\n")
    return _ROLE.sub("", first).replace("`", "")


def source(described: type) -> str:
    """Return authors and year of each paper of the section "References": "Wang et al. 2008".

    Returns
    -------
    str
        ``"this project"`` where the section begins with "Not from a publication", empty where
        there is no such section.
    """
    section = _REFERENCES.search(inspect.cleandoc(described.__doc__ or ""))
    text = section[1] if section else ""
    if text.startswith("Not from a publication"):
        return OURS
    papers = (" ".join(paper.split()) for paper in text.split("\n\n"))
    cited = (_AUTHORS_AND_YEAR.match(paper) for paper in papers)
    return "; ".join(dict.fromkeys(_short(match[1], match[2]) for match in cited if match))


def _short(authors: str, year: str) -> str:
    names = [_INITIALS.sub("", author) for author in _BETWEEN_AUTHORS.split(authors)]
    return f"{' and '.join(names) if len(names) <= _FEW else f'{names[0]} et al.'} {year}"
