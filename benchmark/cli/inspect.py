"""``mocapbench inspect``: say what a careful technician would look for in the user's recordings."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mocapbench import benchmark as bench
from mocapbench import datasets
from mocapbench.benchmark import recording_checks
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.ending.failures import explain
from mocapbench.benchmark.cli.options import Plugins, load_plugins
from mocapbench.benchmark.errors import ExitCode, UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark import Reading

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def inspect(
    files: Annotated[list[Path], typer.Argument(help="The recordings to look at.")],
    rate: Annotated[
        float | None, typer.Option(help="Frames per second, in place of what the files say.")
    ] = None,
    missing: Annotated[
        str | None,
        typer.Option(
            help="What marks missing values where motion cannot tell: zeros, held, a number, none."
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print all findings as JSON.")] = False,
    plugin: Plugins = None,
) -> None:
    """Say what a technician would look for in your own recordings.

    Gaps, ends, frames without any marker, missing rows, and values that mark missing ones; spikes
    and jumps of markers and other channels; markers that trade places, and segments whose length
    jumps. The gravest come first, a few of each marker.

    With --json, each finding has its kind (empty, never, swap, jump, spike, segment, rows, zeros,
    held, number, gap, before, after), markers or channels, frames [start, stop) from 0, time in
    seconds, size and unit; a file that cannot be read has file and error. The exit code is 0 if all
    files can be read, whatever is found, and else 2.

    Found are 69 to 82 % of planted spikes of 20 mm, 96 % of 50 mm and 99 % of 200 mm; 99 % of
    swaps of near joints from one frame to the next, and 90 % in gaps of 0.1 to 0.4 s. A minute, 11
    spikes, 3 jumps and 12 segments are found in CMU's 135_02, and 22 spikes and 32 jumps in joints
    of CMU's skeletons, without hands and feet 15 and 6. Which of these are faults of the recordings
    is not known.
    """
    load_plugins(plugin)
    reading = bench.Reading(rate, missing=bench.choose_missing_rule(missing))
    checks = [_check_or_explain(file, reading) for file in files]
    if as_json:
        typer.echo(json.dumps(checks, indent=1))
    else:
        _show_checks(each for each in checks if "error" not in each)
    raise typer.Exit(ExitCode.USAGE if any("error" in each for each in checks) else ExitCode.OK)


def _check_or_explain(file: Path, reading: Reading) -> dict[str, Any]:
    """Return the check of a file, or why it cannot be read, which is said, too."""
    try:
        return recording_checks.check_file(file, reading)
    except (datasets.FormatError, UsageError, OSError) as error:
        explain(error)
        return {"file": str(file), "error": str(error)}


def _show_checks(checks: Iterable[dict[str, Any]]) -> None:
    console = LiteralConsole()
    for line in chain.from_iterable(map(recording_checks.describe_check, checks)):
        console.print(line, soft_wrap=True, highlight=False)
