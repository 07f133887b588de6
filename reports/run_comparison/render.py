"""The page of two runs: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.resources import fill_template, styles
from mocapbench.reports.run_comparison.chart import slope_chart
from mocapbench.reports.run_comparison.values import ChangeVerdict, RunChanges, ScoreChange
from mocapbench.reports.text import MINUS

__all__ = ["render_changes"]


def render_changes(changes: RunChanges) -> str:
    """Return what changed between two runs as one self-contained HTML page."""
    slopes, identical = _slopes(changes)
    return fill_template(
        "page.html.j2",
        "mocapbench.reports.run_comparison",
        changes=changes,
        summary=_summary(changes),
        slopes=slopes,
        identical=identical,
        metrics=_metrics(changes),
        only=list(zip(changes.names, changes.only, strict=True)),
        digits=_digits,
        css=styles(),
    )


def _metrics(changes: RunChanges) -> Mapping[str, str]:
    return {
        name: info.title for metrics in changes.metrics.values() for name, info in metrics.items()
    }


def _summary(changes: RunChanges) -> str:
    """Return the sentence that the page begins with."""
    counts, (_, other) = changes.counts, changes.names
    parts = [
        f"{counts[ChangeVerdict.BETTER]} better and {counts[ChangeVerdict.WORSE]} worse in "
        f"{other} by more than chance",
        f"{counts[ChangeVerdict.MAY_BE_CHANCE]} differ by what may be chance",
        f"{counts[ChangeVerdict.UNTESTED]} differ over too few units to test",
        f"{counts[ChangeVerdict.INCOMPLETE]} are incomplete",
        f"{counts[ChangeVerdict.IDENTICAL]} are identical",
    ]
    return (
        f"Of {format_count(len(changes.scores), 'score')} that both runs have, {', '.join(parts)}. "
        f"{format_count(len(changes.newly_failing), 'job')} newly without a score, "
        f"{len(changes.newly_passing)} newly with one."
    )


def _slopes(changes: RunChanges) -> tuple[list[tuple[str, str, int, Markup]], list[str]]:
    """Return the charts of the tasks of which anything changed, and the titles of the others.

    A chart stands with the titles of its task and metric, and how many cells it shows.
    """
    slopes, identical = [], []
    for name, title in changes.titles.items():
        metric = next(iter(changes.metrics[name].values()))
        scores = [s for s in changes.scores if (s.task, s.metric) == (name, metric.name)]
        if _all_identical(scores):
            identical.append(title)
        else:
            label = f"{title}: {metric.title} of each cell in both runs"
            chart = slope_chart(label, changes.names, scores)
            slopes.append((title, metric.title, len(scores), chart))
    return slopes, identical


def _all_identical(scores: Sequence[ScoreChange]) -> bool:
    return all(score.verdict is ChangeVerdict.IDENTICAL for score in scores)


def _digits(value: float) -> str:
    return f"{value:.4g}".replace("-", MINUS)
