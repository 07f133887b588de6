"""The state of a run and the explanation of a plan, as tables and lines."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime

from rich.table import Column, Table

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.explanation import Changes, Explanation, Step, in_words
from mocapbench.benchmark.inspection.state import RunState
from mocapbench.benchmark.inspection.work import describe_work
from mocapbench.benchmark.runs import progress
from mocapbench.benchmark.runs.key_parts import DIGEST

__all__ = ["explanation_table", "state_lines", "state_table"]

_STATES = ("done", "failed", "data missing", "left")
_DIFFERENT = DIGEST
"""In place of a value that is not the same for all jobs of a line: it is not shown."""


def explanation_table(explanations: Sequence[Explanation]) -> Table:
    """Return one line for all entrants of a task with whose jobs the same is done and why."""
    title, task_column = _summary(explanations), Column("task", no_wrap=True)
    table = Table(
        task_column, Column("entrants", overflow="fold"), "jobs", "what", "why", title=title
    )
    entrants: dict[str, set[str]] = defaultdict(set)
    lines: dict[tuple[str, Step, str, tuple[str, ...]], list[Explanation]] = defaultdict(list)
    for item in explanations:
        entrants[item.address.task].add(item.address.label)
        lines[item.address.task, item.step, item.cause, (*item.changes,)].append(item)
    for (task, step, cause, _), items in lines.items():
        labels = dict.fromkeys(item.address.label for item in items)
        every = len(labels) > 1 and labels.keys() == entrants[task]
        named = f"all {len(labels)}" if every else ", ".join(labels)
        new = in_words(_common([item.changes for item in items]))
        why = f"{cause}: {new}" if new else cause
        table.add_row(task, named, str(len(items)), step.value, why)
    return table


def _summary(explanations: Sequence[Explanation]) -> str:
    counts = ((step, sum(item.step is step for item in explanations)) for step in Step)
    parts = ", ".join(f"{step.value} {count}" for step, count in counts if count)
    return f"{format_count(len(explanations), 'job')}: {parts}"


def _common(several: Sequence[Changes]) -> Changes:
    """Return the changes of parts that all have, with those values that are the same for all."""
    common = {}
    for part in several[0]:
        before, after = map(set, zip(*(changes[part] for changes in several), strict=True))
        common[part] = (_same_value(before), _same_value(after))
    return common


def _same_value(values: Collection[str]) -> str:
    return next(iter(values)) if len(values) == 1 else _DIFFERENT


def state_table(tasks: Mapping[str, Counter[str]], total: Counter[str]) -> Table:
    """Return one line a task, and one for all."""
    table = Table("task", "jobs", *_STATES)
    for name, counts in tasks.items():
        table.add_row(name, *_cells(counts))
    table.add_section()
    table.add_row("all", *_cells(total))
    return table


def _cells(counts: Counter[str]) -> Iterator[str]:
    yield from map(str, (counts.total(), *(counts[state] for state in _STATES)))


def state_lines(state: RunState, now: datetime) -> Iterable[str]:
    """Return in words how a run goes.

    Parameters
    ----------
    state : RunState
    now : datetime
        With its time zone.
    """
    lines = [f"{state.name}{_origin(state.about, now)}"]
    if "wall time" in state.about and not state.writing:
        lines.append(f"wall time: {state.about['wall time']}")
    if state.work_left:
        lines.append(f"time left: {describe_work(state.work_left, state.workers)}")
    if state.name == "interrupted":
        lines.append("the same command resumes it")
    return lines


def _origin(about: Mapping[str, str], now: datetime) -> str:
    if "merged from" in about:
        return f", merged from {about['merged from']}"
    return _since(about.get("started", ""), now)


def _since(started: str, now: datetime) -> str:
    try:
        begun = datetime.fromisoformat(started)
        ago = progress.in_words((now - begun).total_seconds())
    except (ValueError, TypeError):  # no time, or one without a time zone
        return ""
    return f", started {begun.astimezone(UTC):%Y-%m-%d %H:%M} UTC, {ago} ago"
