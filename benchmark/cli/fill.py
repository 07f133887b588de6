"""``mocapbench fill``: fill the gaps of the user's own recordings."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from shlex import join
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from rich.padding import Padding
from rich.table import Column, Table

from mocapbench import benchmark as bench
from mocapbench import datasets, reports
from mocapbench.basics.freed_memory import return_freed_memory
from mocapbench.basics.words import format_count
from mocapbench.benchmark import filling, recording_checks
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.ending.failures import explain
from mocapbench.benchmark.cli.options import Plugins, load_plugins
from mocapbench.benchmark.errors import ExitCode, UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark.filling import InputFile, OutputPaths, Workers
    from mocapbench.benchmark.filling.filled_recording import FilledRecording

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

_PLAIN_INTERVAL = 5.0
"""Seconds between lines of progress."""
_MOST_GAPS, _FIRST_GAPS = 12, 10
"""Up to how many gaps are all printed, and how many of more."""
_PRINTED = ["gap", "frames", "filled by", "expected error"]
_FRAMES = re.compile(r"(\d{1,9}):(\d{1,9})")


@app.command()
def fill(
    files: Annotated[list[Path], typer.Argument(help="The recordings to fill.")],
    train: Annotated[
        list[Path] | None, typer.Option(help="A recording to learn from besides; may be repeated.")
    ] = None,
    model: Annotated[
        str,
        typer.Option(
            help="A model, or best: the one that errs least in held-out gaps. Or rules, of which "
            "the first counts: 'LKNE=linear,R*:0-99=makima,*=best'."
        ),
    ] = "best",
    frames: Annotated[
        str | None, typer.Option(help="Fill frames A:B (0-based, without B), not the gaps.")
    ] = None,
    channels: Annotated[
        list[str] | None,
        typer.Option(help="Fill only these markers, joints or channels: 'LKNE,R*'."),
    ] = None,
    leave: Annotated[
        list[str] | None,
        typer.Option(help="Leave these gaps open: a marker, perhaps with frames: LKNE:412-455."),
    ] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="Leave all but these gaps open: 'R*,LKNE:412-455'.")
    ] = None,
    out: Annotated[
        Path, typer.Option(help="The folder to write to; nothing in it is overwritten.")
    ] = Path("mocapbench-filled"),
    max_gap: Annotated[
        float | None, typer.Option(min=0.0, help="Seconds; leave longer gaps open.")
    ] = None,
    ends: Annotated[
        Literal["open", "fill"],
        typer.Option(help="Before a marker is first seen and after it is last seen: open or fill."),
    ] = "open",
    effort: Annotated[
        Literal["low", "normal", "high"],
        typer.Option(help="How much work the choice among models may take."),
    ] = "normal",
    seed: Annotated[
        int, typer.Option(min=0, help="Of where gaps are held out, and of what models draw.")
    ] = 0,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="How many models run at once; all cores by default.")
    ] = None,
    rate: Annotated[
        float | None, typer.Option(help="Frames per second, in place of what the files say.")
    ] = None,
    min_likelihood: Annotated[
        float | None, typer.Option(help="Fill what a file itself finds less likely than this, too.")
    ] = None,
    insert_missing: Annotated[
        bool,
        typer.Option("--insert-missing", help="Add the rows that a table lacks, and fill them."),
    ] = False,
    missing: Annotated[
        str | None,
        typer.Option(
            help="What marks missing values where motion cannot tell: zeros, held, a number, none."
        ),
    ] = None,
    hide_spikes: Annotated[
        bool, typer.Option("--hide-spikes", help="Hide spikes first, and fill them as gaps.")
    ] = False,
    plugin: Plugins = None,
) -> None:
    """Fill the gaps of your own recordings.

    Each file is written in its own format, with a table of every filled entry and a page that
    shows them. Spikes, jumps, swaps and odd segments beside gaps are said, as in mocapbench
    inspect.
    """
    named = [rule.rpartition("=")[2].strip() for rule in model.split(",")]
    console, plugins = LiteralConsole(), load_plugins(plugin, named)
    outputs = dict(zip(files, filling.name_output_files(files, out), strict=True))
    entries = filling.NamedEntries(
        _parse_frames(frames),
        filling.split_names(channels or ()),
        max_gap,
        ends == "fill",
        model,
        filling.split_names(leave or ()),
        filling.split_names(only or ()),
    )
    reading = bench.Reading(
        rate,
        min_likelihood,
        insert_missing,
        bench.choose_missing_rule(missing),
        recording_checks.tell_spikes if hide_spikes else None,
    )

    def check(input_file: InputFile) -> None:
        with _name_file(input_file):
            filling.require_fillable(input_file.request, seed)
        filling.require_writable(input_file, outputs[input_file.path])

    inputs, refused = filling.read_input_files(files, train or (), reading, entries, check)
    codes = [_explain_refusal(error, console) for error in refused]
    try:
        with filling.Workers(jobs or bench.n_cores(), plugins, seed) as workers:
            for input_file in inputs:
                paths = outputs[input_file.path]
                codes.append(_fill_file(input_file, workers, effort, paths, console))
    except KeyboardInterrupt:
        console.print("interrupted; files that were filled are kept, others were not written")
        raise
    raise typer.Exit(max(codes, default=ExitCode.OK))


@contextmanager
def _name_file(input_file: InputFile) -> Iterator[None]:
    """Say in errors which file they are of."""
    try:
        yield
    except UsageError as error:
        raise UsageError(f"{input_file.path}: {error}") from error


def _explain_refusal(error: Exception, console: LiteralConsole) -> ExitCode:
    """Say why a file is not filled, and return the exit code for it."""
    if isinstance(error, filling.NothingToFillError):
        console.print(f"left out: {error}", soft_wrap=True, highlight=False)
        return ExitCode.OK
    return explain(error)


def _fill_file(
    input_file: InputFile,
    workers: Workers,
    effort: str,
    outputs: OutputPaths,
    console: LiteralConsole,
) -> ExitCode:
    """Fill a file, say why if that is impossible, and return the exit code for it."""
    try:
        with filling.reserve_outputs(outputs) as drafts:
            return_freed_memory()  # of reading: other processes need some now
            filled = _compare_models(input_file, workers, effort, console)
            return_freed_memory()
            gaps = filling.tabulate_gaps(filled)
            page = filling.compose_page(input_file, filled, gaps, _quote_command())
            filling.write(input_file, filled, gaps, drafts, reports.render_filled(page))
    except (datasets.FormatError, UsageError, OSError) as error:
        return explain(error)
    _print_result(page, outputs, console)
    return ExitCode.NOT_REPEATABLE if filled.stopped else ExitCode.OK


def _compare_models(
    input_file: InputFile, workers: Workers, effort: str, console: LiteralConsole
) -> FilledRecording:
    """Fill a file by the models that err least in held-out gaps, and show how far that is."""
    name = input_file.path.name
    with console.status(f"{name}: comparing models") as status, _name_file(input_file):
        show = status.update if console.is_terminal else _print_now_and_then(console)
        return filling.fill(input_file.request, workers, effort, _make_watch(name, show))


def _make_watch(name: str, show: Callable[[str], object]) -> Callable[[int, int], None]:
    started = time.monotonic()

    def watch(done: int, total: int) -> None:
        show(f"{name}: {done} of {total} hold-outs filled, {time.monotonic() - started:.0f} s")

    return watch


def _print_now_and_then(console: LiteralConsole) -> Callable[[str], None]:
    """Return what prints a line unless it printed one just before, where there is no terminal."""
    shown = time.monotonic()

    def show(text: str) -> None:
        nonlocal shown
        if time.monotonic() - shown >= _PLAIN_INTERVAL:
            console.print(text, soft_wrap=True, highlight=False)
            shown = time.monotonic()

    return show


def _print_result(page: reports.FilledPage, outputs: OutputPaths, console: LiteralConsole) -> None:
    for text in (page.headline, *page.verdict, *page.remarks):
        console.print(f"{page.file}: {text}", soft_wrap=True, highlight=False)
    _print_gaps(page, outputs, console)
    for path in outputs:
        console.print(f"  {path}", soft_wrap=True, highlight=False)


def _print_gaps(page: reports.FilledPage, outputs: OutputPaths, console: LiteralConsole) -> None:
    """Print all gaps if they are few, or else those with most cautions."""
    n_gaps = len(page.gaps)
    n_shown = n_gaps if n_gaps <= _MOST_GAPS else _FIRST_GAPS
    columns = [Column(name, no_wrap=True) for name in _PRINTED]
    grid = Table(*columns, "caution", box=None, pad_edge=False, header_style="")
    for row in page.gaps[:n_shown][[*_PRINTED, "caution"]].itertuples(index=False):
        grid.add_row(*row)
    console.print(Padding.indent(grid, 2), highlight=False)
    if n_gaps > n_shown:
        more = format_count(n_gaps - n_shown, "more gap is", "more gaps are")
        console.print(f"  {more} in {outputs[2]}", soft_wrap=True, highlight=False)
    console.print(f"  {page.options}", soft_wrap=True, highlight=False)


def _parse_frames(frames: str | None) -> tuple[int, int] | None:
    if frames is None:
        return None
    found = _FRAMES.fullmatch(frames)
    if found is None:
        raise UsageError(f"--frames: expected A:B, such as 120:180, got {frames!r}")
    return int(found[1]), int(found[2])


def _quote_command() -> str:
    return join(["mocapbench", *sys.argv[1:]])
