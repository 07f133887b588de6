"""From values to reStructuredText, by templates."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from markupsafe import escape
from sphinx.util import rst
from sphinx.util.template import ReSTRenderer

__all__ = ["link", "plain", "render"]

_TEMPLATES = Path(__file__).with_name("templates")


def render(template: str, **values: Any) -> str:
    """Return the page that the template of this name makes of ``values``."""
    return _renderer().render(f"{template}.rst.j2", values)


@cache
def _renderer() -> ReSTRenderer:
    renderer = ReSTRenderer([str(_TEMPLATES)])
    renderer.env.filters |= {"plain": plain, "e_html": escape}
    renderer.env.globals |= {"link": link}
    renderer.env.trim_blocks = renderer.env.lstrip_blocks = True
    return renderer


def plain(text: object) -> str:
    """Return ``text`` such that nothing in it is markup."""
    return rst.escape(str(text))


def link(kind: str, name: str, text: str = "") -> str:
    """Return a link to the page of a task, model or metric."""
    return f":doc:`{plain(text or name)} </generated/{kind}/{name}>`"
