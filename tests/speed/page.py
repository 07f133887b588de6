"""Tables in Markdown, and their places in a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

__all__ = ["place", "table"]


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def place(page: Path, name: str, text: str) -> None:
    """Put the text between the comments ``<!-- name -->`` and ``<!-- /name -->`` of a page.

    Raises
    ------
    ValueError
        If the page lacks these comments.
    """
    opening, closing = f"<!-- {name} -->", f"<!-- /{name} -->"
    between = re.compile(re.escape(opening) + ".*" + re.escape(closing), re.DOTALL)
    old = page.read_text(encoding="utf-8")
    if not between.search(old):
        raise ValueError(f"expected {opening} and {closing} in {page}, not found: add them")
    whole = f"{opening}\n{text}\n{closing}"
    page.write_text(between.sub(lambda _: whole, old), encoding="utf-8")
