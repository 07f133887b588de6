"""Write how to cite mocapbench, and the works that it follows, from CITATION.cff."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml
from sphinx.application import Sphinx

__all__ = ["as_bibtex", "as_text", "setup"]

Work = Mapping[str, Any]


def setup(app: Sphinx) -> dict[str, bool]:
    """Have the text written when Sphinx begins; `docs/cite.md` includes it."""
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def as_text(work: Work) -> str:
    """Return a work as a line of a bibliography."""
    authors = [" ".join(_names(author)) for author in work["authors"]]
    ends = ("thesis-type", "journal", "collection-title", "institution", "version", "license")
    parts = [", ".join(authors), f"*{work['title']}*"]
    parts += [_named(key, work[key]) for key in ends if key in work]
    parts += [str(work[key]) for key in ("year", "url") if key in work]
    return ". ".join(parts) + "."


def as_bibtex(work: Work) -> str:
    """Return the entry of a program for BibTeX."""
    fields = {
        "title": work["title"],
        "author": " and ".join(f"{{{' '.join(_names(author))}}}" for author in work["authors"]),
        "version": work["version"],
        "url": work["url"],
    }
    lines = [f"  {name:7} = {{{value}}}," for name, value in fields.items()]
    return "\n".join(["@software{mocapbench,", *lines, "}"])


def _names(author: Mapping[str, str]) -> list[str]:
    return [author[key] for key in ("given-names", "family-names", "name") if key in author]


def _named(key: str, value: Any) -> str:
    """Return a field in words: an institution has a name, and a number needs to be explained."""
    words = {"version": "Version {}", "license": "{} licence"}
    return words.get(key, "{}").format(value["name"] if key == "institution" else value)


def _write(app: Sphinx) -> None:
    cited = yaml.safe_load((Path(app.srcdir).parent / "CITATION.cff").read_text(encoding="utf-8"))
    works = "\n".join(f"- {as_text(work)}" for work in cited["references"])
    folder = Path(app.srcdir) / "generated"
    folder.mkdir(exist_ok=True)
    (folder / "citation.md").write_text(
        f"{cited['message']}\n\n{as_text(cited)}\n\n```bibtex\n{as_bibtex(cited)}\n```\n\n"
        f"## Works whose protocols and models it has\n\n{works}\n",
        encoding="utf-8",
    )
