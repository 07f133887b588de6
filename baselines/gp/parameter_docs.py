"""Parameters that several models share, documented once.

The docstring of a class that is decorated with `document_like` says of its other parameters what
that of another class says, in ``help`` and in the pages on models alike. numpydoc could take a
docstring apart, too, but it is needed only to build the documentation.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from typing import TypeVar

__all__ = ["document_like"]

Class = TypeVar("Class", bound=type)


def document_like(source: type) -> Callable[[Class], Class]:
    """Return a decorator that completes the docstring of a class from that of ``source``.

    Parameters of the class that it does not document itself are documented as in ``source``; so are
    attributes, if it is a subclass. Parameters are in the order of the signature.
    """

    def complete(model: Class) -> Class:
        if model.__doc__ and source.__doc__:  # python -OO leaves them out
            model.__doc__ = _join_sections(_complete_sections(model, source))
        return model

    return complete


def _complete_sections(model: type, source: type) -> Mapping[str, str]:
    own, others = _split_sections(model.__doc__), _split_sections(source.__doc__)
    parameters = _split_entries(others["Parameters"]) | _split_entries(own["Parameters"])
    names = [name for name in inspect.signature(model).parameters if name in parameters]
    own["Parameters"] = "\n".join(parameters[name] for name in names)
    if issubclass(model, source):
        attributes = _split_entries(others["Attributes"]) | _split_entries(own["Attributes"])
        own["Attributes"] = "\n".join(attributes.values())
    return own


def _split_sections(docstring: str | None) -> dict[str, str]:
    """Return the sections by their titles; what is before the first one has none."""
    head, *rest = re.split(r"^(\w+)\n-+\n", inspect.cleandoc(docstring or ""), flags=re.MULTILINE)
    found = dict(zip(rest[::2], rest[1::2], strict=True))
    return {"": head, "Parameters": "", "Attributes": "", **found}


def _split_entries(section: str) -> dict[str, str]:
    """Return the entries of a section by what is before their colons."""
    entries = re.split(r"^(?=\S)", section.strip(), flags=re.MULTILINE)
    return {entry.partition(" : ")[0]: entry.rstrip() for entry in entries if entry}


def _join_sections(sections: Mapping[str, str]) -> str:
    """Return a docstring of those sections that are not empty."""
    texts = {title: text.strip() for title, text in sections.items() if text.strip()}
    titles = {title: f"{title}\n{'-' * len(title)}\n" if title else "" for title in texts}
    return "\n\n".join(titles[title] + text for title, text in texts.items())
