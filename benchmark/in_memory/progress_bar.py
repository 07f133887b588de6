"""Progress of what takes long, where somebody looks: in a terminal or in Jupyter."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from rich.progress import Progress

from mocapbench.benchmark.cli.console import LiteralConsole

__all__ = ["show_progress"]


@contextmanager
def show_progress(text: str) -> Iterator[Callable[[int, int], object]]:
    """Yield what is called with how much is done, and how much that is in all."""
    console = LiteralConsole(stderr=True)
    # Without widgets, rich would print in Jupyter that they are missing, and no bar.
    has_widgets = console.is_jupyter and find_spec("ipywidgets") is not None
    watched = console.is_terminal or has_widgets
    with Progress(console=console, transient=True, disable=not watched) as progress:
        task = progress.add_task(text, total=None)

        def watch(done: int, total: int) -> None:
            progress.update(task, completed=done, total=total)

        yield watch
