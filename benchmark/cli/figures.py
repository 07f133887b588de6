"""``mocapbench figures``: the figures of a run for a paper or for slides, each with its data."""

from __future__ import annotations

import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import encode_text, write_together
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    DataDir,
    Names,
    Plugins,
    load_plugins,
    load_records,
    load_tasks,
    open_archive,
    require_names,
    show_left_out,
    split,
)
from mocapbench.benchmark.errors import UnknownNameError, UsageError

if TYPE_CHECKING:
    import pandas as pd

    from mocapbench.benchmark import RunDirectory

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

ADVICE = "pip install 'mocapbench[figures]'"
_INCHES = {"cm": 1 / 2.54, "mm": 1 / 25.4, "in": 1.0, "pt": 1 / 72.27}
_NARROWEST, _WIDEST = 1.0, 60.0
"""Inches."""


@app.command()
def figures(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
    kinds: Annotated[
        list[str] | None,
        typer.Option(
            help="Of error-bars, by-case, along-gap, gap-length, recordings, calibration, ranks, "
            "covariances, stick-figures and cost.",
            callback=require_names,
        ),
    ] = None,
    tasks: Names = None,
    cases: Names = None,
    models: Names = None,
    metrics: Names = None,
    formats: Annotated[
        list[str] | None, typer.Option("--format", help="Of pdf, svg and png.")
    ] = None,
    width: Annotated[str, typer.Option(help="Such as 8.4cm, 84mm, 3.3in or 240pt.")] = "",
    style: Annotated[str, typer.Option(help="paper or slides: the size of text.")] = "paper",
    to: Annotated[
        Path | None, typer.Option(help="Folder of the files; by default RUN/figures.")
    ] = None,
    data_dir: DataDir = None,
    plugin: Plugins = None,
) -> None:
    """Draw figures for a paper or slides, each with its data.

    By default every kind is drawn that the run has data for, as PDF of 8.4 cm. Beside a figure
    are its numbers (.csv), its caption with the command that draws it (.txt), and both for LaTeX
    (.tex).
    """
    load_plugins(plugin)
    named = {"kinds": split(kinds), "tasks": split(tasks), "models": split(models)}
    named |= {"metrics": split(metrics), "format": split(formats) or ("pdf",)}
    named["cases"] = tuple(cases or ())
    _require_drawable(named, style)
    size, folder = _read_size(style, width), to or run / "figures"
    store, console = bench.RunDirectory(run), LiteralConsole()
    whole, styles = _bundle_run(store, named, data_dir)
    kinds_shown = named["kinds"] or [*reports.FIGURE_KINDS]
    tables, lacking = reports.tabulate_figures(whole, kinds_shown, named["metrics"])
    given: dict[str, Sequence[str]] = {
        "width": (width,),
        "style": (style,),
        "to": (str(to or ""),),
    }
    given |= {"plugin": [*map(str, plugin or ())], "data-dir": (data_dir or "",)}
    contents: dict[str, bytes] = {}
    for (task, kind, name), table in tables.items():
        command = _command_of(run, {**named, **given, "kinds": (kind,), "tasks": (task,)})
        caption = reports.describe_figure(whole, task, kind, table)
        texts = {"csv": reports.csv_text(table), "txt": f"{caption}\n\n{command}\n"}
        texts |= _write_latex(name, caption, named["format"])
        files = _draw(kind, name, table, styles, size, named["format"])
        files |= {end: encode_text(text) for end, text in texts.items()}
        contents |= {f"{name}.{end}": file for end, file in files.items()}
    _show_lacking(lacking, console)
    show_left_out(store.damaged, console)
    if not contents:
        raise UsageError("the run has no data for any figure of what is chosen")
    _write(folder, contents)
    console.print(f"{format_count(len(tables), 'figure')}: {folder}", soft_wrap=True)


def _require_drawable(named: Mapping[str, Sequence[str]], style: str) -> None:
    """Refuse kinds, formats and styles that there are not, and a machine that cannot draw."""
    if find_spec("seaborn") is None:
        raise UsageError(f"figures are drawn by seaborn, which is not installed: {ADVICE}")
    _require_known("kind of figure", named["kinds"], [*reports.FIGURE_KINDS])
    _require_known("format", named["format"], reports.FIGURE_FORMATS)
    _require_known("style", [style], [*reports.LOOKS])


def _bundle_run(
    store: RunDirectory, named: Mapping[str, Sequence[str]], data_dir: str | None
) -> tuple[reports.Bundle, Mapping[str, reports.DrawingStyle]]:
    """Return what is chosen of a run, and the styles that its page has for all models."""
    task_files, records = load_tasks(store), load_records(store)
    archive = open_archive(data_dir, task_files)
    whole = bench.bundle(records, store.load_plan()["provenance"])
    tasks = bench.find_tasks(whole, named["tasks"])
    cases = bench.find_cases(whole, named["cases"])
    labels = bench.find_labels(whole, named["models"])
    bench.find_metrics(whole, named["metrics"])
    shown = [one for one in records if one.address.task in tasks]
    shown = [one for one in shown if one.address.case in cases or not cases]
    kinds = named["kinds"] or [*reports.FIGURE_KINDS]
    wanted = any(reports.FIGURE_KINDS[kind].shows_pictures for kind in kinds)
    chosen = replace(
        reports.select_results(whole, tasks, cases, labels),
        illustrations=bench.illustrations(shown, store, archive) if wanted else (),
        parts=bench.error_parts(shown, archive),
    )
    return chosen, reports.model_styles(whole.layouts)


def _read_size(style: str, width: str) -> tuple[float, float]:
    """Return the size of text in points, and the width of figures in inches."""
    points, centimetres = reports.LOOKS[style]
    found = re.fullmatch(r"(\d+(?:\.\d+)?) ?(cm|mm|in|pt)", width or f"{centimetres}cm")
    inches = float(found[1]) * _INCHES[found[2]] if found else 0.0
    if not _NARROWEST <= inches <= _WIDEST:
        raise UsageError(
            f"--width: expected a width from 2.54cm to 152cm, such as 8.4cm, 84mm, 3.3in or 240pt, "
            f"got {width!r}"
        )
    return points, inches


def _require_known(kind: str, names: Sequence[str], known: Sequence[str]) -> None:
    for name in names:
        if name not in known:
            raise UnknownNameError(kind, name, known)


def _command_of(run: Path, options: Mapping[str, Sequence[str]]) -> str:
    """Return the command that draws a figure alone."""
    words = [f"--{name}={text}" for name, texts in options.items() for text in texts if text]
    return shlex.join(["mocapbench", "figures", str(run), *words])


def _draw(
    kind: str,
    name: str,
    table: pd.DataFrame,
    styles: Mapping[str, reports.DrawingStyle],
    size: tuple[float, float],
    formats: Sequence[str],
) -> dict[str, bytes]:
    """Return a figure in each format."""
    try:
        return reports.render_figure(kind, table, styles, size, formats)
    except reports.NothingToDrawError as error:
        advice = "name more, or fewer models with --models"
        raise UsageError(f"--width: {error} for {name}; {advice}") from error


def _write_latex(name: str, caption: str, formats: Sequence[str]) -> dict[str, str]:
    """Return what shows a figure in a document, if it is in a format that LaTeX takes."""
    shown = [f"{name}.{end}" for end in ("pdf", "png") if end in formats]
    return {"tex": reports.figure_latex(shown[0], caption, name)} if shown else {}


def _write(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Write all files or none."""
    folder.mkdir(parents=True, exist_ok=True)
    with write_together(folder, "figures") as drafts:
        for name, content in contents.items():
            (drafts / name).write_bytes(content)


def _show_lacking(
    lacking: Mapping[tuple[str, str], Sequence[str]], console: LiteralConsole
) -> None:
    """Say in a line of each kind and reason which tasks have no such figure."""
    for (kind, reason), tasks in lacking.items():
        console.print(f"no {kind} of {', '.join(tasks)}: {reason}", soft_wrap=True)
