"""One column of the scoreboard: the mean of every model in one task."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.case_means import case_means
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.front.board import INCOMPLETE, SHADES, BoardCell
from mocapbench.reports.text import cell_anchor, number

__all__ = ["WORSE", "board_cells", "first_metric", "is_generated", "reference_of"]

WORSE = "worse"
NEXT = 1.0 + 1e-9
"""Only the best has its shade, alone."""
TRIVIAL = "trivial"


def first_metric(results: TaskResults) -> str:
    """Return the metric by which the task is scored."""
    return results.layout.page.metrics[0]


def is_generated(results: TaskResults) -> bool:
    """Return whether all cases that count are of generated motion, which stands for recordings."""
    cases = results.representative_cases(first_metric(results))
    return bool(cases) and all(case.synthetic for case in cases)


def board_cells(results: TaskResults) -> Mapping[str, BoardCell]:
    """Return the cell of each label that has a score."""
    metric = first_metric(results)
    ranked = {standing.label: standing for standing in standings(results, metric)}
    return {
        label: _cell(results, metric, label, mean, ranked)
        for label in results.layout.labels
        if (mean := _mean(results, metric, label)) is not None
    }


def reference_of(results: TaskResults) -> str | None:
    """Return the label that a model has to beat: replayed training motion, else the channel mean.

    None where the task has neither.
    """
    metric, layout = first_metric(results), results.layout
    names = (layout.replay, TRIVIAL)
    return next((name for name in names if _mean(results, metric, name) is not None), None)


def _mean(results: TaskResults, metric: str, label: str) -> float | None:
    """Return the mean over the cases that count; None where the label has no score."""
    means = case_means(results, metric, label)
    return float(np.mean(means)) if means else None


def _mean_loss(results: TaskResults, metric: str, label: str) -> float:
    """Return the mean loss over the cases that count, where the label has a score."""
    return float(np.mean([*map(results.metrics[metric].loss, case_means(results, metric, label))]))


def _cell(
    results: TaskResults, metric: str, label: str, mean: float, ranked: Mapping[str, Standing]
) -> BoardCell:
    link = cell_anchor(results.layout.name, "", label)
    text = number(mean, results.decimals[metric])
    if label not in ranked:
        return BoardCell(text, mean, link=link)
    own, best = ranked[label], next(iter(ranked.values()))
    lacking = _lacking(own, best, len(results.representative_cases(metric)))
    if not own.complete:
        return BoardCell(text, mean, INCOMPLETE, link=link, note=f"{INCOMPLETE} ({lacking})")
    reference = reference_of(results)
    beaten = label != reference and _beaten(results, metric, label, reference)
    return BoardCell(text, mean, _shade(results, metric, own, best), beaten, link, lacking)


def _lacking(own: Standing, best: Standing, n_cases: int) -> str:
    """Return how much of the cases, or else of the best one's folds, there is; empty if all."""
    if own.n_cases < n_cases:
        return f"{own.n_cases} of {n_cases} cases"
    return "" if own.complete else f"{own.n_folds} of {best.n_folds} folds"


def _beaten(results: TaskResults, metric: str, label: str, reference: str | None) -> bool:
    """Return whether a label is no better than the reference."""
    if reference is None:
        return False
    own, other = (_mean_loss(results, metric, name) for name in (label, reference))
    return own >= other


def _shade(results: TaskResults, metric: str, own: Standing, best: Standing) -> str:
    """Return the name of the shade: how many times worse than the best a mean is."""
    times = 1.0 if own is best else _times_worse(results, metric, own, best)
    return next((name for most, name in SHADES if times <= most), WORSE)


def _times_worse(results: TaskResults, metric: str, own: Standing, best: Standing) -> float:
    """Return the ratio of a mean to the best one, above 1; infinite across zero.

    Where there is a target, it is of the mean distances from it.
    """
    sizes = [own.mean, best.mean]
    if results.metrics[metric].direction is Direction.TARGET:
        sizes = [_mean_loss(results, metric, one.label) for one in (own, best)]
    least, most = sorted(sizes)
    return max(most / least, NEXT) if least > 0.0 else math.inf
