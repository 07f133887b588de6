"""The ranking as the page shows it: a row a model, and the models without a rank."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.trials.comparison import Choice
from mocapbench.reports import RankedModel

__all__ = ["left_out", "ranked", "units"]


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
            filled.choice.seconds[model],
            _note(filled.choice, model, chosen=filled.model),
        )


def left_out(filled: Filled) -> Iterator[tuple[str, str]]:
    """Yield the models without a rank, each with the reason."""
    for runner in filled.choice.left_out if filled.choice else ():
        done = f"{format_count(len(runner.answers), 'trial')} done; " if runner.answers else ""
        yield runner.model, f"{done}{runner.trouble}"


def units(filled: Filled) -> tuple[str, ...]:
    """Return the units of the filled channels, in order of appearance."""
    given, target = filled.source.request.given, filled.source.request.target
    channels = np.flatnonzero(target.any(axis=0))
    return tuple(dict.fromkeys(given.units[channel] for channel in channels))


def _note(choice: Choice, model: str, *, chosen: str) -> str:
    ranking = choice.ranking
    alike = f"lead of {ranking.order[0]} may be chance" if model in ranking.rivals else ""
    notes = ("chosen" if model == chosen else "", alike)
    windows = "fitted to windows" if choice.windows[model] else ""
    return ", ".join(filter(None, (*notes, windows)))
