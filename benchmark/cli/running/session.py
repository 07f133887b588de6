"""One run of planned jobs, from the plan in the run directory to the report."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import typer

from mocapbench import benchmark as bench
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import show_left_out
from mocapbench.benchmark.cli.report import write_report
from mocapbench.benchmark.cli.running.log import run_log
from mocapbench.benchmark.cli.running.messages import fetching, summary, wall_time, without_report
from mocapbench.benchmark.errors import ExitCode

if TYPE_CHECKING:
    from pathlib import Path

    from mocapbench.benchmark import Backend, Job, Record, RunDirectory, WorkerConfig
    from mocapbench.benchmark.events import EventLog
    from mocapbench.datasets import Archive

__all__ = ["Session", "end_if_finished"]


@dataclass(frozen=True, eq=False)
class Session:
    """One run of planned jobs.

    Parameters
    ----------
    planned : sequence of Job
    store : RunDirectory
        Locked by the caller.
    config : WorkerConfig
    backend : Backend
        Where the jobs run.
    console : LiteralConsole
    log : EventLog
    basis : mapping
        What `end_if_finished` of a later run needs, beside the plan; may be empty.
    """

    planned: Sequence[Job]
    store: RunDirectory
    config: WorkerConfig
    backend: Backend
    console: LiteralConsole
    log: EventLog
    basis: Mapping[str, Any]

    def run(self, *, with_report: bool) -> ExitCode:
        """Run the jobs, say how they ended, and write the report unless it shows them already."""
        about, started = dict(self.config.provenance), time.monotonic()
        save_plan = self._plan_writer()
        drawn = bench.last_drawn(self.store, [job.key for job in self.planned])
        self._say(*bench.left_out_lines(self.store, self.planned))
        if not drawn:
            save_plan(provenance=about)
        records = self._records()
        self._say_how_it_ended(records)
        stamp = bench.stamp(records, [*self.config.plugins], self.config.task_files)
        if stamp == drawn:
            _say_nothing_is_new(self.store, self.console)
            return _exit_code(records)
        about["wall time"] = wall_time(time.monotonic() - started, records, about["started"])
        save_plan(provenance=about)
        if with_report:
            self._write_report(records, about)
            save_plan(provenance=about, drawn=bench.mark_drawn(stamp, self._page))
        else:
            self._say(without_report(self.store.path, self._page))
        return _exit_code(records)

    @property
    def _page(self) -> Path:
        return _page_of(self.store)

    def _plan_writer(self) -> Callable[..., None]:
        """Return a function that writes the plan, and what else is to be said of it."""
        task_files = [*self.config.task_files]
        same = {"workers": self.backend.n_workers, "task_files": task_files, **self.basis}

        def save_plan(**about: Any) -> None:
            self.store.save_plan(bench.plan_document(self.planned, **same, **about))

        return save_plan

    def _records(self) -> list[Record]:
        """Run the jobs and return their records; if interrupted, say what becomes of them."""
        try:
            return bench.run(
                self.planned,
                self.store,
                self.config,
                backend=self.backend,
                console=self.console,
                log=self.log,
            )
        except KeyboardInterrupt:
            self._say("interrupted; everything finished is kept, and the same command resumes")
            raise

    def _write_report(self, records: Sequence[Record], about: dict[str, str]) -> None:
        archive = bench.archive_at(*self.config.folders)
        write_report(records, about, self.store, archive, self._page, self.console)

    def _say_how_it_ended(self, records: Sequence[Record]) -> None:
        if bench.lacking(self.planned):
            archive = bench.archive_at(*self.config.folders)
            remedy = fetching(self.planned, archive, self.config.plugins)
            self._say(bench.lacking_line(self.planned, remedy))
        self.console.print(summary(records))

    def _say(self, *lines: str) -> None:
        for line in lines:
            self.console.print(line, soft_wrap=True, highlight=False)


def end_if_finished(
    store: RunDirectory,
    asked: Sequence[Any],
    archive: Archive,
    console: LiteralConsole,
    log_file: Path | None,
) -> None:
    """End the command, as `Session` would, if the run in the folder is finished and nothing is new.

    Parameters
    ----------
    store : RunDirectory
        Locked by the caller.
    asked : sequence
        What the user asked for, as JSON can hold it.
    archive : Archive
    console : LiteralConsole
    log_file : Path or None
        To which events are added.

    Raises
    ------
    typer.Exit
        If it is.
    """
    records = bench.finished_records(store, asked, archive)
    if not records:
        return
    with run_log(log_file) as log:
        log.tell_run_start(store.path, len(records), len(records))
        console.print(f"{len(records)} of {len(records)} jobs are in {store.path} already")
        console.print(summary(records))
        _say_nothing_is_new(store, console)
        raise typer.Exit(_exit_code(records))


def _say_nothing_is_new(store: RunDirectory, console: LiteralConsole) -> None:
    console.print(f"nothing new; report: {_page_of(store).resolve()}", soft_wrap=True)
    show_left_out(store.damaged, console)


def _page_of(store: RunDirectory) -> Path:
    return store.path / "report.html"


def _exit_code(records: Sequence[Record]) -> ExitCode:
    """Return whether jobs failed, or all of them were left out."""
    if any(record.status.broken for record in records):
        return ExitCode.JOBS_FAILED
    done = any(record.status is bench.Status.OK for record in records)
    return ExitCode.OK if done else ExitCode.NOTHING_RAN
