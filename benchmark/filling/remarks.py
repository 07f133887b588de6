"""What the page and the terminal say of a filled file."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mocapbench.benchmark.filling.fill import Filled
from mocapbench.reports import RankedModel

__all__ = ["headline", "left_out", "ranked", "remarks", "units", "verdict"]


def headline(filled: Filled) -> str:
    """Return which model filled how much."""
    request = filled.source.request
    n_entries, n_gaps = int(request.target.sum()), len(request.gaps)
    gaps = "1 gap" if n_gaps == 1 else f"{n_gaps} gaps"
    return f"{filled.model} filled {n_entries} entries in {gaps}."


def verdict(filled: Filled) -> str:
    """Return by how much the model leads in trials, and whether by more than chance."""
    if filled.choice is None:
        return ""
    ranking = filled.choice.ranking
    trials = f"{ranking.n} trial gap{'s' if ranking.n != 1 else ''}"
    if len(ranking.order) == 1:
        return f"No other model has a rank, over {trials}."
    if ranking.n < 2:
        return f"It did best in {trials}, which is too few to tell whether that is chance."
    others = [model for model in ranking.sharing if model != ranking.order[0]]
    if not others:
        return f"Its lead over {ranking.order[1]} is more than chance, over {trials}."
    return f"Its lead over {_listed(others)} could be chance, over {trials}."


def remarks(filled: Filled) -> Iterator[str]:
    """Yield what was cut, left open or shortened, and what failed."""
    request, choice = filled.source.request, filled.choice
    for model, trouble in filled.failed:
        yield f"{model} did better in trials, but did not fill the file: {trouble}."
    if filled.windows:
        yield (
            f"{filled.model} does not take a recording of this length: it was fitted to "
            f"{_windows(filled.windows)} around the gaps, each on its own."
        )
    if request.left_open:
        yield f"{len(request.left_open)} longer gaps were left open."
    rest = int((~request.given.visible & ~request.target).sum())
    if rest:
        yield f"{rest} hidden entries stay hidden, since they were not to be filled."
    if choice and choice.share < 1.0:
        yield (
            "No visible stretch is long enough for gaps of the real lengths: trial gaps are down "
            f"to {100 * choice.share:.3g} % as long, and errors in the real ones larger."
        )
    if filled.answer.variance is None:
        yield f"{filled.model} has no predictive distribution: there are no bands."


def ranked(filled: Filled) -> Iterator[RankedModel]:
    """Yield the ranking, the chosen model first."""
    if filled.choice is None:
        return
    ranking = filled.choice.ranking
    for model in ranking.order:
        scores = ranking.scores[model]
        yield RankedModel(
            model,
            ranking.means[model],
            tuple(scores.rmse[unit] for unit in units(filled)),
            scores.coverage,
            filled.choice.seconds[model],
            _note(filled, model),
        )


def left_out(filled: Filled) -> Iterator[tuple[str, str]]:
    """Yield the models without a rank, each with the reason."""
    for runner in filled.choice.left_out if filled.choice else ():
        done = f"{len(runner.answers)} trials done; " if runner.answers else ""
        yield runner.model, f"{done}{runner.trouble}"


def units(filled: Filled) -> tuple[str, ...]:
    """Return the units of the filled channels, in order of appearance."""
    given, target = filled.source.request.given, filled.source.request.target
    channels = np.flatnonzero(target.any(axis=0))
    return tuple(dict.fromkeys(given.units[channel] for channel in channels))


def _note(filled: Filled, model: str) -> str:
    ranking = filled.choice.ranking  # type: ignore[union-attr]
    chosen = "chosen" if model == filled.model else ""
    best = ranking.sharing[0]
    if model == best:
        equal = "" if len(ranking.sharing) == 1 else "least error"
    else:
        equal = f"not separable from {best}" if model in ranking.sharing else ""
    return ", ".join(filter(None, (chosen, equal)))


def _windows(count: int) -> str:
    return "1 window" if count == 1 else f"{count} windows"


def _listed(names: list[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last
