"""``mocapbench run``: run the benchmark and write its report."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.path_lists import named_folders
from mocapbench.basics.scratch import sweep_scratch
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.data import fetch_missing
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    DataDir,
    Names,
    Out,
    Plugins,
    cases_named,
    load_plugins,
    open_archive,
    split,
)
from mocapbench.benchmark.cli.running.about import about
from mocapbench.benchmark.cli.running.log import require_log, run_log
from mocapbench.benchmark.cli.running.messages import downloading, fetching
from mocapbench.benchmark.cli.running.session import Session, end_if_finished
from mocapbench.benchmark.errors import UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark import Job, Request, TaskFile
    from mocapbench.datasets import Archive

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def run(
    profile: Annotated[str, typer.Option(help="smoke, quick or paper.")] = "quick",
    tasks: Names = None,
    models: Names = None,
    cases: Names = None,
    metrics: Names = None,
    folds: Annotated[
        int | None, typer.Option(min=1, max=10_000, help="Folds of each case.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="The root seed.")] = 0,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="How many jobs at once; by default one per core.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="A dask scheduler whose workers run the jobs: its address.")
    ] = None,
    cluster: Annotated[
        str | None, typer.Option(help="local:N starts a dask cluster of N workers here.")
    ] = None,
    threads: Annotated[
        int, typer.Option(min=1, help="Threads of a job; does not affect results.")
    ] = 1,
    out: Out = DEFAULT_OUT,
    data_dir: DataDir = None,
    recordings: Annotated[
        Path | None, typer.Option(help="A folder of your own recordings, with --task-file.")
    ] = None,
    task_file: Annotated[
        list[Path] | None,
        typer.Option(help="A TOML file of what to hide in --recordings; `mocapbench init` helps."),
    ] = None,
    plugin: Plugins = None,
    timeout: Annotated[
        float, typer.Option(min=1, help="Seconds after which a job is killed.")
    ] = 3600.0,
    memory: Annotated[
        float | None,
        typer.Option(min=0.5, max=2**20, help="GiB a job may take; by default a fair share."),
    ] = None,
    offline: Annotated[bool, typer.Option("--offline", help="Download nothing.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show the jobs, run none.")] = False,
    explain: Annotated[
        bool, typer.Option("--explain", help="Show first why each job runs or is skipped.")
    ] = False,
    no_report: Annotated[
        bool, typer.Option("--no-report", help="Write no report; `mocapbench report` does later.")
    ] = False,
    log_json: Annotated[
        Path | None, typer.Option(help="A file to which events are added, one JSON object a line.")
    ] = None,
) -> None:
    """Run the benchmark and write its report.

    What the run directory holds already is not computed again, so that the same command resumes.
    """
    require_log(log_json, out)
    bench.require_backend(jobs, scheduler, cluster)
    if not (dry_run or scheduler or cluster or out.exists()):
        bench.worker_context()  # of a new run, which loads the libraries while it is planned
    console, plugins = LiteralConsole(), load_plugins(plugin, split(models))
    task_files = bench.open_task_files(task_file or (), recordings)
    archive, own = (
        open_archive(data_dir, task_files),
        bench.add_tasks(task_files) if task_files else (),
    )
    sweep_scratch()  # here, since a killed run may have finished all, so that no worker starts
    asked = [profile, split(tasks), split(models), cases or (), split(metrics), folds, seed]
    if not (plugins or task_files or dry_run or explain or no_report):
        _end_if_finished(out, asked, archive, console, log_json)
    chosen = split(tasks) or own
    request = bench.Request(
        profile,
        chosen,
        split(models),
        cases_named(cases or (), chosen),
        split(metrics),
        folds,
        seed,
    )
    if not (offline or dry_run):
        fetch_missing(archive, bench.required_recordings(request, archive), console)
    planned = _plan_jobs(request, archive)
    if explain:
        console.print(bench.explanation_table(bench.explain(planned, out)))
    elif dry_run:
        console.print(bench.plan_table(planned))
    if dry_run:
        n_workers = None if scheduler or cluster else jobs or bench.n_cores()
        remedy = fetching(planned, archive, plugins) if offline else downloading(planned, archive)
        _show(bench.forecast_text(planned, profile, out, n_workers, remedy), console)
        return
    store, backend = bench.RunDirectory.create(out), bench.open_backend(jobs, scheduler, cluster)
    config = bench.WorkerConfig(
        _absolute_folders(data_dir, task_files),
        plugins,
        timeout,
        int((memory or backend.memory) * 2**30),
        threads,
        about(planned, request, threads),
        task_files,
    )
    with run_log(log_json) as log, backend, store.locked():
        store.sweep()
        basis = {} if plugins or task_files else _describe_basis(asked, planned)
        session = Session(planned, store, config, backend, console, log, basis)
        raise typer.Exit(session.run(with_report=not no_report))


def _absolute_folders(data_dir: str | None, task_files: Sequence[TaskFile]) -> tuple[Path, ...]:
    """Return the folders of recordings as processes in other folders find them."""
    folders = bench.with_folders(named_folders(data_dir), task_files)
    return tuple(folder.resolve() for folder in folders)


def _end_if_finished(
    out: Path,
    asked: Sequence[Any],
    archive: Archive,
    console: LiteralConsole,
    log_json: Path | None,
) -> None:
    if bench.RunDirectory.is_run(out) and not (store := bench.RunDirectory(out)).is_locked:
        with store.locked():
            store.sweep()
            end_if_finished(store, asked, archive, console, log_json)


def _describe_basis(asked: Sequence[Any], planned: Sequence[Job]) -> dict[str, Any]:
    digests = {uri: digest for job in planned for uri, digest in job.digests.items()}
    return bench.describe_basis(asked, digests)


def _plan_jobs(request: Request, archive: Archive) -> Sequence[Job]:
    """Return the jobs of a request, of which there must be one at least."""
    planned = bench.plan(request, archive)
    if not planned:
        unmet = "; ".join(bench.list_unmet_needs(request))
        raise UsageError(
            "nothing to run: no chosen model has the abilities that the chosen tasks require"
            f"{f' ({unmet})' if unmet else ''}; `mocapbench list models` shows what each can do"
        )
    return planned


def _show(forecast: Iterable[str], console: LiteralConsole) -> None:
    for line in forecast:
        console.print(line, soft_wrap=True, highlight=False)
