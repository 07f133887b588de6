"""``mocapbench motion``: the motion of one cell of a run, as a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import datasets
from mocapbench.benchmark import motion as motions
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DataDir,
    Plugins,
    load_plugins,
    load_tasks,
    open_archive,
    show_left_out,
)
from mocapbench.benchmark.errors import UsageError

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def motion(
    run: Annotated[Path, typer.Argument(help="The run directory.")],
    cell: Annotated[
        str, typer.Argument(help="TASK/CASE/MODEL of the run, or TASK/CASE/MODEL/FOLD.")
    ],
    gif: Annotated[
        Path | None, typer.Option(help="Stick figures over the truth, from the side.")
    ] = None,
    amc: Annotated[
        Path | None, typer.Option(help="Joint angles; the skeleton is written beside it.")
    ] = None,
    bvh: Annotated[Path | None, typer.Option(help="Joints and their rotations.")] = None,
    csv: Annotated[Path | None, typer.Option(help="All channels as a table.")] = None,
    data_dir: DataDir = None,
    plugin: Plugins = None,
) -> None:
    """Write the motion that a model made as GIF, AMC, BVH or CSV.

    It is the first recording that was filled, with what was visible as recorded, or the first
    sample. Folds are counted from 1; without one, it is the first. No file is overwritten.
    """
    options = {"gif": gif, "amc": amc, "bvh": bvh, "csv": csv}
    files = {kind: path for kind, path in options.items() if path is not None}
    motions.require_new(files)
    load_plugins(plugin)
    store, console = bench.RunDirectory(run), LiteralConsole()
    task_files = load_tasks(store)
    record = motions.find_cell(store.planned(), cell)
    task = bench.TASKS.get(record.address.task)
    archive = open_archive(data_dir, task_files)
    try:
        solved = bench.solved_problem(task, [record], store, archive)
    except datasets.RecordingUnavailable as error:
        raise UsageError(f"{cell}: {error}") from error
    if solved is None:
        show_left_out(store.damaged, console)
        raise UsageError(
            f"{cell}: its prediction is not in {run}, or a recording has changed since; "
            "run it again with `mocapbench run`"
        )
    made = motions.entrant_motion(task, solved)
    recording, *_ = made
    for path in motions.write(made, files, str(record.address)):
        console.print(f"{recording.name}: {path}", soft_wrap=True, highlight=False)
    rate = datasets.frame_rate(recording)
    if amc is not None:
        console.print(f"{amc.name} has {rate:.6g} frames per second, which AMC does not state")
