"""The caption of a score table and the notes below it."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.tables.rank_notes import rank_notes
from mocapbench.reports.text import counted

__all__ = ["OVER_SAMPLES", "score_caption", "score_notes"]

OVER_FOLDS = "2 sd over folds"
OVER_WINDOWS = "spread over overlapping windows (2 sd)"
OVER_SAMPLES = "2 sd over the samples of a fold, averaged over folds"


def score_caption(results: TaskResults, metric: str) -> str:
    """Return the metric's title, the meaning of ±, and which values are better."""
    info = results.metrics[metric]
    goal = info.direction.value if info.target is None else f"closest to {info.target:g}"
    spread = _spread_meaning(results, metric)
    return f"{info.title}: mean ± {spread}, {goal} is better, first rank in bold"


def _spread_meaning(results: TaskResults, metric: str) -> str:
    estimates = (e for (_, _, name), e in results.estimates.items() if name == metric)
    if any(estimate.sample_two_sd is not None for estimate in estimates):
        return OVER_SAMPLES
    return OVER_FOLDS if results.layout.independent_folds else OVER_WINDOWS


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
