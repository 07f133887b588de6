"""One run of planned jobs, from the plan in the run directory to the report."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from mocapbench import benchmark as bench
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import show_left_out
from mocapbench.benchmark.cli.report import write_report
from mocapbench.benchmark.cli.running.messages import fetching, summary, wall_time, without_report
from mocapbench.benchmark.errors import ExitCode

if TYPE_CHECKING:
    from pathlib import Path

    from mocapbench.benchmark import Backend, Job, Record, RunDirectory, WorkerConfig
    from mocapbench.benchmark.events import EventLog

__all__ = ["Session"]


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
    """

    planned: Sequence[Job]
    store: RunDirectory
    config: WorkerConfig
    backend: Backend
    console: LiteralConsole
    log: EventLog

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
            self._say_nothing_is_new()
            return _exit_code(records)
        about["wall time"] = wall_time(time.monotonic() - started, records, about["started"])
        save_plan(provenance=about)
        if with_report:
            self._write_report(records, about)
            save_plan(provenance=about, drawn=stamp)
        else:
            self._say(without_report(self.store.path, self._page))
        return _exit_code(records)

    @property
    def _page(self) -> Path:
        return self.store.path / "report.html"

    def _plan_writer(self) -> Callable[..., None]:
        """Return a function that writes the plan, and what else is to be said of it."""
        task_files = [*self.config.task_files]
        same = {"workers": self.backend.n_workers, "task_files": task_files}

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
        archive = bench.archive_at(self.config.data_dir)
        write_report(records, about, self.store, archive, self._page, self.console)

    def _say_how_it_ended(self, records: Sequence[Record]) -> None:
        if bench.lacking(self.planned):
            remedy = fetching(self.planned, self.config.plugins)
            self._say(bench.lacking_line(self.planned, remedy))
        self.console.print(summary(records))

    def _say_nothing_is_new(self) -> None:
        self.console.print(f"nothing new; report: {self._page.resolve()}", soft_wrap=True)
        show_left_out(self.store.damaged, self.console)

    def _say(self, *lines: str) -> None:
        for line in lines:
            self.console.print(line, soft_wrap=True, highlight=False)


def _exit_code(records: Sequence[Record]) -> ExitCode:
    """Return whether jobs failed, or all of them were left out."""
    if any(record.status.broken for record in records):
        return ExitCode.JOBS_FAILED
    done = any(record.status is bench.Status.OK for record in records)
    return ExitCode.OK if done else ExitCode.NOTHING_RAN
