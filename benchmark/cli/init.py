"""``mocapbench init``: write a task file for recordings of one's own."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.whole_files import write_text
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import Plugins, load_plugins, require_writable
from mocapbench.benchmark.errors import UsageError

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def init(
    task_file: Annotated[Path, typer.Argument(help="The TOML file to write, such as my.toml.")],
    recordings: Annotated[Path, typer.Option(help="A folder of recordings of your own.")],
    rate: Annotated[
        float | None, typer.Option(min=0.001, help="Frames per second, for files without times.")
    ] = None,
    plugin: Plugins = None,
) -> None:
    """Write a task file for recordings of your own.

    It has comments and runs as it stands; nothing is overwritten.
    """
    plugins, console = load_plugins(plugin), LiteralConsole()
    if task_file.exists() or task_file.suffix != ".toml":
        raise UsageError(
            f"init: expected the name of a new .toml file, got {str(task_file)!r}"
            f"{', which exists' if task_file.exists() else ''}; choose another name"
        )
    require_writable(task_file)
    text, tests, left_out = bench.draft(str(task_file), recordings, rate)
    write_text(task_file, text)
    for reason in left_out:
        console.print(f"left out: {reason}", soft_wrap=True, highlight=False)
    count = format_count(len(tests), "recording")
    console.print(f"{task_file}: a task on {count} of {recordings}")
    command = shlex.join(
        [
            *("mocapbench", "run", "--recordings", str(recordings), "--task-file", str(task_file)),
            *(word for path in plugins for word in ("--plugin", str(path))),
        ]
    )
    console.print(f"next: edit it, then `{command}`", soft_wrap=True, highlight=False)
