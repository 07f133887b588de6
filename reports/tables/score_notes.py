"""The caption of a score table and the notes below it."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.tables.rank_notes import rank_notes
from mocapbench.reports.text import counted

__all__ = ["OVER_SAMPLES", "score_caption", "score_notes"]

INTERVAL = "half its 95 % interval"
OVER_SAMPLES = "2 sd over the samples of a fold, averaged over folds"


def score_caption(results: TaskResults, metric: str) -> str:
    """Return the metric's title, the meaning of ±, and which values are better."""
    info = results.metrics[metric]
    goal = info.direction.value if info.target is None else f"closest to {info.target:g}"
    intervals = (
        mean.half_width for (_, _, name), mean in results.estimates.items() if name == metric
    )
    known = any(half is not None for half in intervals)
    spread = f" ± {INTERVAL}" if known else ""
    return f"{info.title}: mean{spread}, {goal} is better, the best in bold"


def score_notes(results: TaskResults, metric: str) -> tuple[str, ...]:
    """Return the task's remarks, and notes on degenerate outputs, unranked labels and tests."""
    return (
        *results.layout.page.remarks,
        *_degenerate(results, metric),
        *_unranked(results.layout),
        *rank_notes(results, metric),
    )


def _degenerate(results: TaskResults, metric: str) -> list[str]:
    left_out = int(
        max(results.scores.loc[results.scores["metric"] == metric, "left_out"], default=0)
    )
    outputs = counted(left_out, "output")
    return [f"Left out as degenerate: up to {outputs} a fold."] if left_out else []


def _unranked(layout: TaskLayout) -> list[str]:
    """Return why some labels of the table are not ranked; nothing where no label is."""
    reasons = {
        layout.oracle: "knows the generating process: a limit",
        layout.control: "negative control: samples of an unrelated process",
        layout.replay: "repeats its training recordings: the score of samples that are not new",
    }
    shown = layout.labels if layout.ranked else ()
    return [f"{label} ({why}) is not ranked." for label, why in reasons.items() if label in shown]
