"""The negative control of a run: whether samples surpass those of an unrelated process."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rich.console import Console
from rich.table import Table

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.results.bundle import bundle
from mocapbench.benchmark.runs.record import Record
from mocapbench.reports.analysis.negative_control import (
    EXEMPT,
    Decision,
    Measure,
    NegativeControlResult,
    negative_control,
)
from mocapbench.reports.analysis.results import task_results

__all__ = ["check_controls"]

NOTHING = (
    "nothing to check: expected scores of the entrant 'control'; run a task that has one, such as "
    "toy-synthesis"
)


def check_controls(records: Sequence[Record], console: Console) -> ExitCode:
    """Show what `negative_control` finds in every task of ``records``, and return the exit code.

    `ExitCode.REGRESSION` if an entrant or a control fails, else `ExitCode.JOBS_FAILED` if a job
    did, `ExitCode.UNDECIDED` if cells are too few to tell, and `ExitCode.NOTHING_RAN` if no task
    has a control with scores.
    """
    results = bundle(records, {})
    by_task = {
        layout.name: negative_control(task_results(results, layout)) for layout in results.layouts
    }
    checked = {task: findings for task, findings in by_task.items() if findings}
    broken = [record for record in records if record.status.broken]
    for task, findings in checked.items():
        console.print(_table(task, findings))
    for line in _lines(checked, broken):
        console.print(line, markup=False, highlight=False, soft_wrap=True)
    return _exit_code([finding for several in checked.values() for finding in several], broken)


def _lines(
    checked: Mapping[str, Sequence[NegativeControlResult]], broken: Sequence[Record]
) -> Iterator[str]:
    """Yield what is to be said below the tables."""
    if not checked:
        yield NOTHING
    for task, findings in checked.items():
        yield from (f"{task}: {reason}" for reason in _reasons(findings))
    for record in broken[:1]:
        failure = f"{record.address.label}: {record.message}"
        jobs = format_count(len(broken), "job")
        yield f"{jobs} failed, and nothing without a score was checked ({failure})"


def _exit_code(findings: Sequence[NegativeControlResult], broken: Sequence[Record]) -> ExitCode:
    if any(finding.failed for finding in findings):
        return ExitCode.REGRESSION
    if broken:
        return ExitCode.JOBS_FAILED
    if any(finding.undecided for finding in findings):
        return ExitCode.UNDECIDED
    return ExitCode.OK if findings else ExitCode.NOTHING_RAN


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
    """Yield why each entrant that did not pass did not, with its worst cells, or is exempt."""
    for finding in findings:
        if finding.failed:
            yield from (
                f"{finding.label} fails by {measure.name}: {_offences(measure)}"
                for measure in finding.measures
                if measure.decision is Decision.FAILED
            )
        elif finding.undecided:
            names = [m.name for m in finding.measures if m.decision is Decision.UNDECIDED]
            yield f"{finding.label} is undecided by {' and '.join(names)}: {_too_few(finding)}"
        elif finding.verdict == EXEMPT:
            yield f"{finding.label} need not pass: it {finding.exempt}"


def _too_few(finding: NegativeControlResult) -> str:
    cells = format_count(finding.n_cells, "cell")
    return f"too few to tell ({cells}: case × fold); run more --folds or --cases"


def _offences(measure: Measure) -> str:
    if measure.estimate is None:
        return "it has no score to set beside the control's"
    return ", ".join(
        f"{case} fold {fold} {value:.3f}" for (case, fold), value in measure.offending.items()
    )
