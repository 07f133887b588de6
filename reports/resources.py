"""The templates, style sheets and scripts of the pages, each of which needs no other file.

Names and messages on a page come from packages, files and runs of others. What a terminal would not
be shown, no page has either: `fill_template` and `dump_json` leave out the same characters.
"""

from __future__ import annotations

import hashlib
import json
from base64 import b64encode
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

from jinja2 import Environment, FunctionLoader, StrictUndefined, Template
from markupsafe import Markup

from mocapbench.basics.words import format_count, printable
from mocapbench.reports.text import slug

__all__ = ["digest_of_script", "dump_json", "fill_template", "scripts", "styles", "template"]

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
    environment.filters |= {"format_count": format_count}
    environment.policies["json.dumps_function"] = dump_json
    return environment.get_template(name)


def fill_template(name: str, package: str = PAGE, **values: Any) -> str:
    """Return the page of a template, which shows nothing but printable text."""
    return printable(template(name, package).render(**values))


def dump_json(value: Any, **options: Any) -> str:
    """Return JSON for the scripts of a page, whose texts are printable, as those of the page."""
    return json.dumps(_print_texts(value), **options)


def _print_texts(value: Any) -> Any:
    match value:
        case str():
            return printable(value)
        case dict():
            return {_print_texts(key): _print_texts(item) for key, item in value.items()}
        case list() | tuple():
            return [*map(_print_texts, value)]
        case _:
            return value


def styles() -> Markup:
    """Return every style sheet that the pages share, in the order of their names."""
    return Markup("\n").join(map(Markup, _every("styles")))


def scripts() -> Markup:
    """Return every script, in the order of their names. Each is a function that calls itself."""
    return Markup("\n").join(map(Markup, _every("scripts")))


def digest_of_script(script: str) -> str:
    """Return by what a page's policy knows a script, so that the browser runs no other.

    Parameters
    ----------
    script : str
        All between the tags of its element.
    """
    return f"'sha256-{b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


def _every(folder: str) -> Iterator[str]:
    names = sorted(file.name for file in (files(PAGE) / folder).iterdir() if file.is_file())
    return (_read_text(PAGE, f"{folder}/{name}") for name in names)


def _read_text(package: str, name: str) -> str:
    return (files(package) / name).read_text(encoding="utf-8")
