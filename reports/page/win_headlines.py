"""Headlines on models that the paper lacks and that are better than the paper's models.

Such a model is often a simple baseline. Every headline says whether a paired test finds the lead
more than chance.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from mocapbench.metrics.statistics import ALPHA
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.wins import Win, wins
from mocapbench.reports.page.headline import Headline, cases_phrase, same_places
from mocapbench.reports.tables.rank_notes import untested_reason

__all__ = ["win_headlines"]


def win_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name, for each of the paper's models, the models that it lacks with a better mean."""
    by_loser = groupby(wins(results, metric), key=lambda win: win.loser)
    return [_headline(results, loser, list(group)) for loser, group in by_loser]


def _headline(results: TaskResults, loser: str, group: Sequence[Win]) -> Headline:
    first, *others = group
    winner_mean, loser_mean = same_places(*first.means)
    where = cases_phrase(first.cases, first.shared)
    sentences = [
        f"in {where}: {winner_mean} on average against {loser_mean}.",
        _overall(results, first),
        *([f"Also, {_others(others)}."] if others else []),
    ]
    return Headline(f"{first.winner} has a better mean than {loser}", " ".join(sentences))


def _others(group: Sequence[Win]) -> str:
    """Return the winners by the result of the test, with their cases where these are not all."""
    by_test: dict[str, list[str]] = {}
    for win in group:
        some = "" if len(win.cases) == win.shared else f" ({len(win.cases)} of {win.shared})"
        by_test.setdefault(_test_result(win), []).append(f"{win.winner}{some}")
    return "; ".join(f"{result}: {', '.join(names)}" for result, names in by_test.items())


def _overall(results: TaskResults, win: Win) -> str:
    contrast = win.overall.contrast
    if contrast.n < 2:
        return f"Not tested: {untested_reason(results)}."
    low, high = same_places(contrast.low, contrast.high)
    units = {1: f"its {contrast.n} folds", 2: "both cases"}.get(
        win.shared, f"all {win.shared} cases"
    )
    return f"Over {units}, 95 % interval of the lead {low} to {high}: {_test_result(win)}."


def _test_result(win: Win) -> str:
    """Return whether the lead over all shared cases is more than chance."""
    contrast = win.overall.contrast
    if contrast.n < 2:
        return "not tested"
    if contrast.advantage > 0.0 and win.overall.separable:
        return "more than chance"
    return "may be chance" if contrast.t_p > ALPHA else "may be chance, after Holm’s correction"
