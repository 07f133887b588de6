"""The negative control of a run: whether samples surpass those of an unrelated process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.table import Table

from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.results.bundle import bundle
from mocapbench.benchmark.runs.record import Record
from mocapbench.reports.analysis.negative_control import negative_control
from mocapbench.reports.analysis.negative_control_result import Measure, NegativeControlResult
from mocapbench.reports.analysis.results import task_results

__all__ = ["check_controls"]


def check_controls(records: Sequence[Record], console: Console) -> ExitCode:
    """Show what `negative_control` finds in every task of ``records``, and return the exit code.

    `ExitCode.REGRESSION` if an entrant or a control fails, `ExitCode.JOBS_FAILED` if a job did,
    `ExitCode.NOTHING_RAN` if no task has a control with scores in two cells.
    """
    results = bundle(records, {})
    by_task = {
        layout.name: negative_control(task_results(results, layout)) for layout in results.layouts
    }
    checked = {task: findings for task, findings in by_task.items() if findings}
    if not checked:
        console.print(
            "nothing to check: expected scores of the entrant 'control' in at least two cells "
            "(case × fold); run a task that has one, such as toy-synthesis"
        )
    for task, findings in checked.items():
        console.print(_table(task, findings))
        for line in _reasons(findings):
            console.print(f"{task}: {line}", markup=False, highlight=False, soft_wrap=True)
    failed = [finding for findings in checked.values() for finding in findings if finding.failed]
    broken = [record for record in records if record.status.broken]
    for record in broken[:1]:
        failure = f"{record.address.label}: {record.message}"
        line = f"{len(broken)} jobs failed and were not checked ({failure})"
        console.print(line, markup=False, highlight=False, soft_wrap=True)
    if failed:
        return ExitCode.REGRESSION
    if broken:
        return ExitCode.JOBS_FAILED
    return ExitCode.OK if checked else ExitCode.NOTHING_RAN


def _table(task: str, findings: Sequence[NegativeControlResult]) -> Table:
    control, *others = findings
    table = Table(
        *("entrant", "cells", f"MLC − {control.label}’s", f"MCC − {control.label}’s"),
        *("variance ratio", "verdict"),
        title=task,
        caption=f"mean ± half the 95 % interval; the row of {control.label} is its own MLC",
    )
    for finding in (*others, control):
        texts = [_estimate(measure) for measure in finding.measures]
        missing = ["–"] * (len(table.columns) - 3 - len(texts))
        table.add_row(finding.label, str(finding.n_cells), *texts, *missing, finding.verdict)
    return table


def _estimate(measure: Measure) -> str:
    if measure.estimate is None:
        return "no score"
    half = measure.estimate.half_width
    return f"{measure.estimate.mean:.3f}" + ("" if half is None else f" ± {half:.3f}")


def _reasons(findings: Sequence[NegativeControlResult]) -> Iterator[str]:
    """Yield why each entrant that failed did so, with its worst cells, or why it is exempt."""
    for finding in findings:
        if finding.failed:
            yield from (
                f"{finding.label} fails by {measure.name}: {_offences(measure)}"
                for measure in finding.measures
                if not measure.passed
            )
        elif not finding.passed:
            yield f"{finding.label} need not pass: it {finding.exempt}"


def _offences(measure: Measure) -> str:
    if measure.estimate is None:
        return "it has no score to set beside the control's"
    cells = [f"{cell.case} fold {cell.fold} {cell.value:.3f}" for cell in measure.offending]
    return (
        ", ".join(cells)
        or "no single case and fold, but there are too few to decide; run more of them"
    )
