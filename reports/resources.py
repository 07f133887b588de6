"""The templates, style sheets and scripts of the pages, each of which needs no other file."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files

from jinja2 import Environment, FunctionLoader, StrictUndefined, Template
from markupsafe import Markup

from mocapbench.basics.words import format_count, printable
from mocapbench.reports.text import slug

__all__ = ["scripts", "styles", "template"]

PAGE = "mocapbench.reports.page"


def template(name: str, package: str = PAGE) -> Template:
    """Return a template of ``package``, which may use the others there."""
    environment = Environment(
        autoescape=True,
        loader=FunctionLoader(lambda part: _read_text(package, part)),
        lstrip_blocks=True,
        trim_blocks=True,
        undefined=StrictUndefined,
    )
    environment.globals["slug"] = slug
    environment.filters |= {"format_count": format_count, "printable": printable}
    return environment.get_template(name)


def styles() -> Markup:
    """Return every style sheet that the pages share, in the order of their names."""
    return Markup("\n").join(map(Markup, _every("styles")))


def scripts() -> Markup:
    """Return every script, in the order of their names. Each is a function that calls itself."""
    return Markup("\n").join(map(Markup, _every("scripts")))


def _every(folder: str) -> Iterator[str]:
    names = sorted(file.name for file in (files(PAGE) / folder).iterdir() if file.is_file())
    return (_read_text(PAGE, f"{folder}/{name}") for name in names)


def _read_text(package: str, name: str) -> str:
    return (files(package) / name).read_text(encoding="utf-8")
