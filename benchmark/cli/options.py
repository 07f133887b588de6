"""Options that several commands have, and what several commands do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from mocapbench import benchmark as bench

__all__ = [
    "DEFAULT_OUT",
    "DataDir",
    "Names",
    "Out",
    "Plugins",
    "load_plugins",
    "show_left_out",
    "split",
]

DEFAULT_OUT = Path("mocapbench-results")

Names = Annotated[list[str] | None, typer.Option(help="Names, repeated or separated by commas.")]
Out = Annotated[Path, typer.Option(help="The run directory: new, empty, or an earlier run's.")]
DataDir = Annotated[
    Path | None,
    typer.Option(envvar="MOCAPBENCH_DATA", help="A folder of recordings (subjects/NN/…)."),
]
Plugins = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin",
        "--model-file",
        help="A Python file that defines any of MODELS, TASKS, METRICS and LIBRARIES.",
    ),
]


def split(names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of an option, however they were separated."""
    parts = (part.strip() for name in names or () for part in name.split(","))
    return tuple(part for part in parts if part)


def load_plugins(paths: Sequence[Path] | None) -> tuple[Path, ...]:
    """Register what the user's own files define, and return their full paths."""
    files = tuple(path.resolve() for path in paths or ())
    for path in files:
        bench.load_plugin(path)
    return files


def show_left_out(damaged: Iterable[str], console: Console) -> None:
    """Name the damaged files of a run directory."""
    for message in dict.fromkeys(damaged):
        console.print(f"damaged, so left out: {message}", markup=False)
