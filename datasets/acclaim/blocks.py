"""The parts of an .asf file: sections, blocks from ``begin`` to ``end``, and fields."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from itertools import takewhile

from mocapbench.datasets.acclaim.text import Line, content_lines

__all__ = ["blocks", "read_fields", "sections"]


def sections(text: str, file: str) -> dict[str, list[Line]]:
    """Return the lines of each section, its heading first, by the heading's first word.

    Raises
    ------
    AcclaimError
        If a section is repeated or a line stands before the first.
    """
    found: dict[str, list[Line]] = {}
    name = ""
    for line in content_lines(text, file):
        if line.words[0].startswith(":"):
            name = line.words[0]
            if name in found:
                raise line.error("every section once")
        elif not name:
            raise line.error("a section such as ':version'")
        found.setdefault(name, []).append(line)
    return found


def blocks(section: Sequence[Line]) -> Iterator[list[Line]]:
    """Yield the lines of each block, its ``begin`` first, without its ``end``.

    Raises
    ------
    AcclaimError
        If anything stands outside a block, or the last one has no ``end``.
    """
    if len(section) > 1 and section[-1].words != ("end",):
        raise section[-1].error("a block from 'begin' to 'end' to close the section")
    lines = iter(section[1:])
    for begin in lines:
        if begin.words != ("begin",):
            raise begin.error("'begin'")
        yield [begin, *takewhile(lambda line: line.words != ("end",), lines)]


def read_fields(
    section: Sequence[Line], required: Set[str], optional: Set[str] = frozenset()
) -> dict[str, Line]:
    """Return the lines below a heading by their first word.

    Parameters
    ----------
    section : sequence of Line
        Of a section or block, its heading first.
    required, optional : set of str
        The fields that it must have, and those that it may have.

    Raises
    ------
    AcclaimError
        If a field is repeated, is missing, or is none of these.
    """
    heading, *lines = section
    fields: dict[str, Line] = {}
    for line in lines:
        name = line.words[0]
        if name.startswith("("):  # further lines of joint limits
            continue
        if name not in required | optional or name in fields:
            raise line.error(f"one of {', '.join(sorted((required | optional) - fields.keys()))}")
        fields[name] = line
    for name in sorted(required - fields.keys()):
        raise heading.error(f"a line {name!r} below")
    return fields
