"""Write the tree of folders, each with the first sentence of its package."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # tests read the tree where Sphinx is not installed
    from sphinx.application import Sphinx


__all__ = ["describe_folders", "find_packages", "setup"]

FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")


def setup(app: Sphinx) -> dict[str, bool]:
    """Have the text written when Sphinx begins; `docs/architecture.md` includes it."""
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def find_packages(root: Path) -> Iterator[tuple[str, str]]:
    """Yield the path of every folder of modules below the root, and what its package says it is."""
    for top in FOLDERS:
        for package in sorted({path.parent for path in (root / top).rglob("*.py")}):
            source = (package / "__init__.py").read_text(encoding="utf-8")
            about = ast.get_docstring(ast.parse(source)) or ""
            yield package.relative_to(root).as_posix(), about.partition("\n")[0]


def describe_folders(root: Path) -> str:
    """Return a nested list of folders."""
    return "\n".join(
        f"{'  ' * path.count('/')}- `{path.rpartition('/')[2]}/`: {about.replace('``', '`')}"
        for path, about in find_packages(root)
    )


def _write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "generated"
    folder.mkdir(exist_ok=True)
    text = describe_folders(Path(app.srcdir).parent)
    (folder / "folders.md").write_text(text + "\n", encoding="utf-8")
