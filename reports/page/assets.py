"""The style sheets and scripts of the pages, which are inlined."""

from __future__ import annotations

from importlib.resources import files

from markupsafe import Markup

__all__ = ["scripts", "stylesheet"]

STYLES = ("styles/colours.css", "styles/figures.css", "report.css")
SCRIPTS = ("report.js", "scripts/highlight.js", "scripts/canvas.js")


def stylesheet() -> Markup:
    """Return the style sheet of a page."""
    return _joined(STYLES)


def scripts() -> Markup:
    """Return the script of the report."""
    return _joined(SCRIPTS)


def _joined(names: tuple[str, ...]) -> Markup:
    folder = files(__package__)
    return Markup("\n".join((folder / name).read_text(encoding="utf-8") for name in names))
