"""Whether differences of scores are more than chance, by the project's paired statistics."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.benchmark.comparison.units import with_advantages
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.results.evaluated_gaps import UNITS, require_columns
from mocapbench.metrics.statistics import ALPHA, ROPE, Contrast, contrast, holm, pair

__all__ = ["compare"]

_PROBLEM = ["recording", "position", "gap"]
_COLUMNS = (*_PROBLEM, "model", "metric", "value")


def compare(scores: pd.DataFrame, *, by: str = "gap", rope: float = ROPE) -> pd.DataFrame:
    """Compare every two models by their scores in the same gaps.

    Parameters
    ----------
    scores : DataFrame
        What `evaluate` returns.
    by : str, default="gap"
        What counts as one: ``"gap"`` says what holds for other gaps of these recordings, where
        gaps that share frames are one; ``"recording"`` says what holds for other recordings. Fewer
        than five are too few to test.
    rope : float
        Half the width of the region of practical equivalence, as a share of the mean score.

    Returns
    -------
    DataFrame
        A row for each ``metric`` and two models, of which the ``first`` has the better mean:
        ``n``, how many count; ``mean_first`` and ``mean_second``; the ``advantage`` of the
        first with its 95 % interval ``low`` to ``high``; ``p`` of the paired t-test, and ``p_holm``
        after Holm's correction over all pairs of the metric; ``signed_rank_p``, by Wilcoxon;
        ``better``, ``equivalent`` and ``worse``, the probabilities by the Bayesian t-test; and the
        ``verdict``.

    Raises
    ------
    ValueError
        If it is no table of scores, or has fewer than two models.

    Examples
    --------
    >>> import mocapbench
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> hide = mocapbench.Gaps(seconds=0.1, what="limb", count=8)
    >>> scores = mocapbench.evaluate(walk, ["hold", "pchip"], hide, metrics=["mse"])
    >>> mocapbench.compare(scores)[["first", "second", "verdict"]].values.tolist()
    [['pchip', 'hold', 'more than chance']]
    """
    _check_scores(scores, by)
    tables = []
    for metric, own in scores.groupby("metric", sort=False):
        rows = pd.DataFrame(_contrast_pairs(str(metric), own, by, rope))
        if len(rows):
            rows.insert([*rows].index("p") + 1, "p_holm", holm(rows["p"]))
            verdicts = [*map(_tell_verdict, rows["p"], rows["p_holm"])]
            tables.append(rows.assign(verdict=verdicts))
    if not tables:
        raise ValueError("expected scores that two models have in common, got none")
    return pd.concat(tables, ignore_index=True)


def _check_scores(scores: pd.DataFrame, by: str) -> None:
    require_columns(scores, _COLUMNS)
    if by not in UNITS:
        raise ValueError(f"expected by= as one of {', '.join(UNITS)}, got {by!r}")
    if scores["model"].nunique() < 2:
        raise ValueError(f"expected two models or more, got {scores['model'].nunique()}")
    repeated = scores.duplicated([*_COLUMNS[:-1]])
    if repeated.any():
        first = scores[[*_COLUMNS[:-1]]][repeated].iloc[0].tolist()
        raise ValueError(f"expected one score of each, got several of {first}")


def _contrast_pairs(
    metric: str, scores: pd.DataFrame, by: str, rope: float
) -> Iterator[dict[str, Any]]:
    """Yield the contrast of every two models, the one with the better mean first."""
    about = metric_info(metric)
    by_model = {
        str(model): own.set_index(_PROBLEM)["value"].astype(float)
        for model, own in scores.groupby("model", sort=False)
    }
    losses = {model: about.loss(values.mean()) for model, values in by_model.items()}
    order = sorted((m for m in by_model if np.isfinite(losses[m])), key=losses.__getitem__)
    for first, second in combinations(order, 2):
        values = pair(by_model[first], by_model[second])
        pairs = with_advantages(values.rename_axis(["case", *_PROBLEM[1:]]), about)
        units = pairs.rename_axis(_PROBLEM).groupby(level=[*UNITS[by]])
        if len(pairs):
            found = contrast(units.mean().assign(share=units.size() / len(pairs)), rope)
            yield {"metric": metric, "first": first, "second": second, **_list_values(found)}


def _list_values(found: Contrast) -> dict[str, float]:
    return {
        "n": found.n,
        "mean_first": found.first,
        "mean_second": found.second,
        "advantage": found.advantage,
        "low": found.low,
        "high": found.high,
        "p": found.t_p,
        "signed_rank_p": found.signed_rank_p,
        "better": found.better,
        "equivalent": found.equivalent,
        "worse": found.worse,
    }


def _tell_verdict(p: float, corrected: float) -> str:
    if np.isnan(p):
        return "too few to test"
    return "more than chance" if corrected <= ALPHA else "may be chance"
