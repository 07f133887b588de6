"""Lead links to files that are no pages of the site to the source repository.

The same Markdown is read on the repository's site, where a link is a path. So the rule is: a link
to what exists beside the pages, such as `../CONTRIBUTING.md` or `../baselines/gp`, becomes an
address in the repository; a link to a page stays as it is.
"""

from __future__ import annotations

import re
from pathlib import Path

from sphinx.application import Sphinx

__all__ = ["setup", "with_source_links"]

LINK = re.compile(r"(?<!!)(\[[^\]]*\]\()([^)#\s:]+)([^)\s]*\))")


def setup(app: Sphinx) -> dict[str, bool]:
    """Have the links changed in each page, and in each file that a page includes."""
    app.add_config_value("source_repository", "", "env", [str])
    app.connect("source-read", _in_page)
    app.connect("include-read", _in_included)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def with_source_links(text: str, folder: Path, pages: Path, repository: str) -> str:
    """Return Markdown with links out of the site as addresses.

    Parameters
    ----------
    text : str
        Markdown, whose links are relative to `folder`.
    folder : path
        Where the text stands.
    pages : path
        The folder of all pages, which is in the root of the source tree.
    repository : str
        Address of the source tree.
    """

    def led(match: re.Match[str]) -> str:
        target = (folder / match[2]).resolve()
        is_page = target.suffix == ".md" and target.is_relative_to(pages)
        if is_page or not target.exists():
            return match[0]
        kind = "tree" if target.is_dir() else "blob"
        path = target.relative_to(pages.parent).as_posix()
        return f"{match[1]}{repository}/{kind}/main/{path}{match[3]}"

    return LINK.sub(led, text)


def _in_page(app: Sphinx, name: str, content: list[str]) -> None:
    _replace(app, app.env.doc2path(name), content)


def _in_included(app: Sphinx, path: Path, _parent: str, content: list[str]) -> None:
    _replace(app, app.srcdir / path, content)


def _replace(app: Sphinx, path: Path, content: list[str]) -> None:
    pages = Path(app.srcdir).resolve()
    folder = path.resolve().parent
    content[0] = with_source_links(content[0], folder, pages, app.config.source_repository)
