"""Run the tutorials' notebooks, so that those to download show what they compute."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode
from sphinx.application import Sphinx
from sphinx_gallery.py_source_parser import split_code_and_text_blocks

__all__ = ["run_notebook", "setup", "show_drawing"]

_AFTER_THE_GALLERY = 900
"""Sphinx calls what has a higher number later; the gallery, which writes them, has the default."""
_MARKS = ("# sphinx_gallery_start_ignore", "# sphinx_gallery_end_ignore")
"""Lines of scripts between which is what pages hide."""
_SLOWEST_START = 600
"""Seconds in which a kernel answers even on a busy machine."""
_BESIDE_CELLS = "module://matplotlib_inline.backend_inline"
"""Where a kernel draws by default, which the gallery's own choice for this process would undo."""


def setup(app: Sphinx) -> dict[str, bool]:
    """Have the notebooks run before Sphinx copies what can be downloaded."""
    app.connect("builder-inited", _run_all, priority=_AFTER_THE_GALLERY)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def run_notebook(path: Path, folder: Path) -> None:
    """Run a notebook in a folder, and keep what its cells print and draw; once is enough.

    Raises
    ------
    nbclient.exceptions.CellExecutionError
        If a cell fails.
    """
    notebook = nbformat.read(path, as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    if not any(cell.execution_count for cell in code):
        show_drawing(code, path.with_suffix(".py"))
        where = {"metadata": {"path": str(folder)}}
        client = NotebookClient(notebook, startup_timeout=_SLOWEST_START, resources=where)
        client.execute(env={**os.environ, "MPLBACKEND": _BESIDE_CELLS})
        nbformat.write(notebook, path)


def show_drawing(cells: Sequence[NotebookNode], script: Path) -> None:
    """Give code cells what draws, which pages hide, as the script of the notebook has it."""
    if script.exists():
        _, blocks = split_code_and_text_blocks(str(script))
        texts = [text for kind, text, _ in blocks if kind == "code"]
        for cell, text in zip(cells, texts, strict=True):
            lines = [line for line in text.splitlines() if not line.startswith(_MARKS)]
            cell.source = "\n".join(lines).strip()


def _run_all(app: Sphinx) -> None:
    if app.builder.format == "html":  # what only checks links runs nothing
        notebooks = sorted(Path(app.srcdir, "generated", "tutorials").glob("*.ipynb"))
        run = partial(run_notebook, folder=Path(app.srcdir, "tutorials"))
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(run, notebooks))
