"""``mocapbench export``: everything in a run directory as tables, or tables for a paper."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import atomic_write, write_bytes, write_text, write_together
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    Names,
    Plugins,
    load_plugins,
    load_records,
    load_tasks,
    show_left_out,
    split,
)
from mocapbench.benchmark.errors import ExitCode, UnknownNameError, UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import pandas as pd

    from mocapbench.benchmark import RunDirectory

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

PAPER_FILES = {
    "latex": "tables.tex",
    "markdown": "tables.md",
    "csv": "tables.csv",
    "parquet": "tables.parquet",
    "xlsx": "tables.xlsx",
}
"""The formats of tables for papers, and their files."""
NEEDED = {"parquet": "pyarrow", "xlsx": "openpyxl"}
"""The packages that formats need, which extras of their names bring."""
PARQUET_ADVICE = "which need pyarrow: `pip install 'mocapbench[parquet]'`"


@app.command()
def export(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
    to: Annotated[Path | None, typer.Option(help="Folder of the files; by default RUN.")] = None,
    formats: Annotated[
        list[str] | None,
        typer.Option("--format", help=f"Of tables for papers: {', '.join(PAPER_FILES)}."),
    ] = None,
    tasks: Names = None,
    cases: Names = None,
    models: Names = None,
    metrics: Names = None,
    plugin: Plugins = None,
) -> None:
    """Write the scores and jobs of a run, or tables for papers.

    Of the last run there. Scores and jobs are CSV, and Parquet where pyarrow is installed. With
    --format, there is a table for each task: means with intervals and tests, of what is named, in
    that order.
    """
    load_plugins(plugin)
    store, console, folder = bench.RunDirectory(run), LiteralConsole(), to or run
    if formats:
        chosen = {"tasks": tasks, "models": models, "metrics": metrics}
        names = {option: split(given) for option, given in chosen.items()}
        _export_means(store, _paper_paths(folder, split(formats)), names, cases or (), console)
    elif tasks or cases or models or metrics:
        raise UsageError(
            "--tasks, --cases, --models and --metrics choose what tables for papers show; add "
            f"--format with any of {', '.join(PAPER_FILES)}"
        )
    else:
        _export_all(store, folder, console)


def _export_all(store: RunDirectory, folder: Path, console: LiteralConsole) -> None:
    """Write all scores and jobs."""
    with_parquet = find_spec("pyarrow") is not None
    folder.mkdir(parents=True, exist_ok=True)
    records = store.planned()
    tables = {"scores": bench.score_table(records), "jobs": bench.job_table(records)}
    suffixes = ".csv and .parquet" if with_parquet else ".csv"
    with write_together(folder, "tables") as drafts:
        for name, table in tables.items():
            _write_csv(table, drafts / f"{name}.csv")
            if with_parquet:
                _write_parquet(table, drafts / f"{name}.parquet")
    for name, table in tables.items():
        console.print(
            f"{format_count(len(table), 'row')}: {folder / name}{suffixes}", soft_wrap=True
        )
    if not with_parquet:
        console.print(f"no Parquet files, {PARQUET_ADVICE}")
    show_left_out(store.damaged, console)
    if earlier := len(store.record_keys() - {*store.load_plan()["keys"]}):
        jobs = format_count(earlier, "job")
        console.print(f"not exported: {jobs} of earlier runs in {store.path}", soft_wrap=True)
    if not records:
        raise typer.Exit(ExitCode.NOTHING_RAN)


def _paper_paths(folder: Path, formats: Sequence[str]) -> dict[str, Path]:
    """Return the file of each format, none of which may be there.

    Raises
    ------
    UsageError
        If one is, or a format is unknown or needs what is not installed.
    """
    for name in formats:
        if name not in PAPER_FILES:
            raise UnknownNameError("format", name, [*PAPER_FILES])
        if name in NEEDED and find_spec(NEEDED[name]) is None:
            advice = f"pip install 'mocapbench[{name}]'"
            raise UsageError(f"--format {name} needs {NEEDED[name]}: `{advice}`")
    paths = {name: folder / PAPER_FILES[name] for name in formats}
    for path in filter(Path.exists, paths.values()):
        raise UsageError(
            f"expected no file called {path}, which would be overwritten; name another folder "
            "with --to, or delete it"
        )
    return paths


def _export_means(
    store: RunDirectory,
    paths: Mapping[str, Path],
    names: Mapping[str, Sequence[str]],
    cases: Sequence[str],
    console: LiteralConsole,
) -> None:
    """Write tables for papers of what is named, and say which models have no row there."""
    load_tasks(store)
    whole = bench.bundle(load_records(store), store.load_plan()["provenance"])
    labels = bench.find_labels(whole, names["models"])
    metrics = bench.find_metrics(whole, names["metrics"])
    means, tables = reports.paper_tables(
        whole,
        bench.find_tasks(whole, names["tasks"]),
        bench.find_cases(whole, cases),
        labels,
        metrics,
    )
    if means.empty:
        raise UsageError(
            "no score of what is chosen: no such model has a score by such a metric in these tasks "
            "and cases; leave one of these options out"
        )
    _write_means(means, tables, whole, paths)
    for path in paths.values():
        console.print(f"{format_count(len(tables), 'table')}: {path}", soft_wrap=True)
    chosen = [(labels, means["label"]), (metrics, means["metric"])]
    if lost := [name for named, shown in chosen for name in named if name not in {*shown}]:
        console.print(f"without a score there, so not shown: {', '.join(lost)}", soft_wrap=True)
    show_left_out(store.damaged, console)


def _write_means(
    means: pd.DataFrame,
    tables: Sequence[reports.Table],
    whole: reports.Bundle,
    paths: Mapping[str, Path],
) -> None:
    """Write the files of all formats, or none."""
    folder = next(iter(paths.values())).parent
    folder.mkdir(parents=True, exist_ok=True)
    with write_together(folder, "tables") as drafts:
        for name, path in paths.items():
            match name:
                case "latex":
                    write_text(drafts / path.name, reports.latex_text(tables, whole))
                case "markdown":
                    write_text(drafts / path.name, reports.markdown_text(tables))
                case "csv":
                    _write_csv(means, drafts / path.name)
                case "xlsx":
                    write_bytes(drafts / path.name, reports.xlsx_bytes(means, "means"))
                case _:
                    _write_parquet(means, drafts / path.name)


def _write_csv(table: pd.DataFrame, path: Path) -> None:
    write_text(path, reports.csv_text(table))


def _write_parquet(table: pd.DataFrame, path: Path) -> None:
    with atomic_write(path) as file:
        table.to_parquet(file, index=False)
