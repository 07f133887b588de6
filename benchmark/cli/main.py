"""The command line."""

from __future__ import annotations

import os
import signal
import sys
import time
import traceback
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from mocapbench.benchmark.cli import check as cli_check
from mocapbench.benchmark.cli import compare as cli_compare
from mocapbench.benchmark.cli import data as cli_data
from mocapbench.benchmark.cli import inspect as cli_inspect
from mocapbench.benchmark.cli.options import Names, split
from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.registry import load_model_file
from mocapbench.benchmark.runs.job import Job, Settings
from mocapbench.benchmark.runs.plan import Request, plan, required_sources
from mocapbench.benchmark.runs.provenance import provenance
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.run import run as run_jobs
from mocapbench.benchmark.runs.store import Store
from mocapbench.datasets import CMU_ACKNOWLEDGEMENT, AcclaimError, Archive, DigestMismatch

__all__ = ["app", "main"]

DEFAULT_OUT = Path("mocapbench-results")
MINIMUM_MEMORY = 4.0

app = typer.Typer(
    name="mocapbench",
    help="Reproducible benchmarks of models of human motion.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(cli_data.app, name="data")
app.command("list")(cli_inspect.list_registered)
app.command("info")(cli_inspect.info)
app.command("export")(cli_inspect.export)
app.command("check")(cli_check.check)
app.command("compare")(cli_compare.compare)

ModelFiles = Annotated[list[Path] | None, typer.Option(help="A Python file that defines MODELS.")]
Out = Annotated[Path, typer.Option(help="The run directory: new, empty, or an earlier run's.")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; user errors become one clear line and exit code 2."""
    console = Console(stderr=True)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]  # terminals that know ASCII only
    try:
        app(args=None if arguments is None else list(arguments))
    except (UsageError, DigestMismatch, AcclaimError) as error:
        console.print(f"[bold red]error:[/] {escape(str(error))}", soft_wrap=True)
        sys.exit(ExitCode.USAGE)
    except OSError as error:
        console.print(f"[bold red]error:[/] cannot read or write: {escape(str(error))}")
        sys.exit(ExitCode.USAGE)
    except Exception:  # else the interpreter's exit code would say that a metric got worse
        traceback.print_exc()
        console.print("[bold red]error:[/] a defect of mocapbench or an added package; see above")
        sys.exit(ExitCode.DEFECT)


@app.command()
def run(
    profile: Annotated[str, typer.Option(help="smoke, quick or paper.")] = "quick",
    tasks: Names = None,
    models: Names = None,
    cases: Names = None,
    metrics: Names = None,
    folds: Annotated[int | None, typer.Option(min=1, help="Folds of each case.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="The root seed.")] = 0,
    jobs: Annotated[int, typer.Option(min=1, help="How many jobs at once.")] = os.cpu_count() or 1,
    threads: Annotated[
        int, typer.Option(min=1, help="Threads of a job; results do not depend on it.")
    ] = 1,
    out: Out = DEFAULT_OUT,
    data_dir: cli_data.DataDir = None,
    model_file: ModelFiles = None,
    timeout: Annotated[
        float, typer.Option(min=1, help="Seconds after which a job is killed.")
    ] = 3600.0,
    memory: Annotated[
        float | None,
        typer.Option(min=0.5, max=2**20, help="GiB a job may take; by default a fair share."),
    ] = None,
    offline: Annotated[bool, typer.Option("--offline", help="Download nothing.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show the jobs, run none.")] = False,
) -> None:
    """Run the benchmark and write its report; what the run directory holds is not run again."""
    console = Console()
    files = tuple(path.resolve() for path in model_file or ())
    for path in files:
        load_model_file(path)
    request = Request(
        profile, split(tasks), split(models), split(cases), split(metrics), folds, seed
    )
    archive = cli_data.archive_at(data_dir)
    if not (offline or dry_run):
        cli_data.fetch_missing(archive, required_sources(request), console)
    planned = plan(request, archive)
    if not planned:
        raise UsageError(
            "nothing to run: no chosen model has the abilities that the chosen tasks require; "
            "`mocapbench list models` shows what each can do"
        )
    if dry_run:
        console.print(_plan_table(planned))
        return
    store = Store.create(out)
    about = {
        **provenance(["mocapbench", *sys.argv[1:]], threads),
        "profile": profile,
        "seed": str(seed),
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        **_acknowledgement(planned),
    }
    limit = int((memory or _memory_share(jobs)) * 2**30)
    data = data_dir.resolve() if data_dir else None
    settings = Settings(out.resolve(), data, files, timeout, limit, threads, about)
    signal.signal(signal.SIGTERM, _interrupt)
    with store.locked():
        raise typer.Exit(_run(planned, store, settings, jobs, console))


def _interrupt(_signal: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _run(
    planned: Sequence[Job], store: Store, settings: Settings, n_workers: int, console: Console
) -> ExitCode:
    keys = [job.key for job in planned]
    store.save_plan({"keys": keys, "provenance": dict(settings.provenance)})
    started = time.monotonic()
    try:
        records = run_jobs(planned, store, settings, n_workers=n_workers, console=console)
    except KeyboardInterrupt:
        console.print("interrupted; everything finished is kept, and the same command resumes")
        return ExitCode.INTERRUPTED
    about = {**settings.provenance, "wall time": f"{time.monotonic() - started:.0f} s"}
    store.save_plan({"keys": keys, "provenance": about})
    _show_damage(store, console)
    code = _verdict(records, console)
    archive = cli_data.archive_at(settings.data_dir)
    _write_report(records, about, store, archive, store.path / "report.html", console)
    return code


def _verdict(records: Sequence[Record], console: Console) -> ExitCode:
    """Say in one line how the run ended, and return the exit code for it."""
    counts = {status: sum(r.status is status for r in records) for status in Status}
    summary = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    for message in dict.fromkeys(r.message for r in records if r.status is Status.DATA_MISSING):
        console.print(f"data missing: {message}", markup=False, soft_wrap=True)
    console.print(f"{len(records)} jobs: {summary}")
    if any(record.status.broken for record in records):
        return ExitCode.JOBS_FAILED
    return ExitCode.OK if counts[Status.OK] else ExitCode.NOTHING_RAN


@app.command()
def report(
    out: Out = DEFAULT_OUT,
    to: Annotated[Path | None, typer.Option(help="The HTML file to write.")] = None,
    data_dir: cli_data.DataDir = None,
    model_file: ModelFiles = None,
) -> None:
    """Write the HTML report of a run directory."""
    for path in model_file or ():
        load_model_file(path)
    store, console = Store.open(out), Console()
    plan_made, records = store.load_plan(), store.planned()
    if not records:
        raise UsageError(f"{out} holds no record of its last run; run `mocapbench run`")
    archive, path = cli_data.archive_at(data_dir), to or out / "report.html"
    _write_report(records, plan_made["provenance"], store, archive, path, console)
    _show_damage(store, console)


def _write_report(
    records: Sequence[Record],
    about: Mapping[str, str],
    store: Store,
    archive: Archive,
    path: Path,
    console: Console,
) -> None:
    # Plotting libraries take a second to import, which every command and worker would pay.
    from mocapbench.benchmark.figures.illustrations import illustrations  # noqa: PLC0415
    from mocapbench.benchmark.results.bundle import bundle  # noqa: PLC0415
    from mocapbench.reports import render  # noqa: PLC0415

    figures = illustrations(records, store, archive)
    page = render(bundle(records, about, figures, store.load_check()))
    with atomic_write(path) as file:
        file.write(page.encode())
    console.print(f"report: {path.resolve()}", soft_wrap=True, highlight=False)


def _show_damage(store: Store, console: Console) -> None:
    for message in dict.fromkeys(store.damaged):
        console.print(f"damaged, so not trusted: {message}", markup=False)


def _plan_table(planned: Sequence[Job]) -> Table:
    table = Table("task", "case", "entrant", "folds", title=f"{len(planned)} jobs")
    rows: dict[tuple[str, str, str], int] = {}
    for job in planned:
        address = (job.seeds.task, job.case, job.label)
        rows[address] = rows.get(address, 0) + 1
    for address, count in rows.items():
        table.add_row(*address, str(count))
    return table


def _acknowledgement(planned: Sequence[Job]) -> dict[str, str]:
    """Return what the database asks to be said of work that uses it."""
    used = any(uri.startswith("cmu:") for job in planned if not job.missing for uri in job.digests)
    return {"acknowledgement": CMU_ACKNOWLEDGEMENT} if used else {}


def _memory_share(n_workers: int) -> float:
    """Return the GiB of this machine's memory that fall to one job."""
    physical = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return max(MINIMUM_MEMORY, physical / n_workers)
