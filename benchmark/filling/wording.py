"""What the page and the terminal say of a filled file."""

from __future__ import annotations

from collections.abc import Iterator

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.filling.cautions import cautions
from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.remaining import remaining
from mocapbench.benchmark.filling.trials.comparison import Choice
from mocapbench.benchmark.filling.trials.ranking import Ranking

__all__ = ["headline", "remarks", "verdict"]

_NAMED = 4
"""Models that a remark names at most."""


def headline(filled: Filled) -> str:
    """Return which model filled how much."""
    request = filled.source.request
    entries = format_count(int(request.target.sum()), "entry", "entries")
    return f"{filled.model} filled {entries} in {format_count(len(request.gaps), 'gap')}."


def verdict(filled: Filled) -> str:
    """Return by how much the model leads in trials, and how good its bands are there."""
    if filled.uncompared:
        return (
            "Nothing could be compared, since no model filled a trial gap within its part of the "
            "budget: raise --budget to choose among models."
        )
    if filled.choice is None:
        named = "The model was named: no trial on this file tells what its bands hold."
        return "" if filled.answer.variance is None else named
    return f"{_lead(filled.choice)} {_bands(filled)}".strip()


def _bands(filled: Filled) -> str:
    """Return what the bands of the choice hold in trials, if it has any and has filled the file."""
    choice = filled.choice
    if choice is None or filled.failed or not choice.ranking.scores[filled.model].has_bands:
        return ""
    if choice.coverage is None:
        return "There was no time to try its bands: a larger --budget may tell what they hold."
    share, n_entries, n_gaps = choice.coverage
    hidden = format_count(n_entries, "hidden entry", "hidden entries")
    gaps = format_count(n_gaps, "trial gap")
    return f"Its 95 % bands hold {100 * share:.0f} % of {hidden} in {gaps}."


def _lead(choice: Choice) -> str:
    ranking, trials = choice.ranking, _trials(choice.ranking)
    if len(ranking.order) == 1:
        return f"No other model has a rank, over {trials}."
    if not ranking.tested:
        return f"It did best in {trials}, too few to tell whether that is chance."
    if len(ranking.sharing) == 1:
        return f"Its lead over {ranking.order[1]} is more than chance, over {trials}."
    if not ranking.rivals:
        return f"It leads by far, but gaps differ too much for a test, over {trials}."
    rivals = join_names(ranking.rivals, len(ranking.rivals))
    return f"Its lead over {rivals} may be chance, over {trials}."


def _trials(ranking: Ranking) -> str:
    trials = format_count(ranking.n, "trial gap")
    at = f" at {format_count(ranking.n_places, 'place')}" if ranking.n_places < ranking.n else ""
    return trials + at


def remarks(filled: Filled) -> Iterator[str]:
    """Yield what was cut, left open or shortened, and what failed."""
    request, choice = filled.source.request, filled.choice
    for model, trouble in filled.failed:
        yield f"{model} did better in trials, but did not fill the file: {trouble}."
    if filled.windows:
        yield (
            f"{filled.model} does not take a recording of this length: it was fitted to "
            f"{_windows(filled.windows)}."
        )
    yield from remaining(request)
    if choice and choice.share < 1.0:
        yield (
            "No visible stretch is long enough for gaps of the real lengths: trial gaps are down "
            f"to {100 * choice.share:.3g} % as long, and errors in the real ones larger."
        )
    if choice and choice.unused and not filled.failed:
        yield (
            f"{filled.model} had no time for {format_count(choice.unused, 'more trial')} that "
            "others had: all are compared without them."
        )
    yield from _late(filled)
    if filled.answer.variance is None:
        none = f"{filled.model} has no predictive distribution: there are no bands."
        yield f"{none} {_with_bands(filled)}".strip()
    yield from cautions(filled)


def _late(filled: Filled) -> Iterator[str]:
    late = [one.model for one in filled.choice.left_out if one.late] if filled.choice else []
    if late:
        yield (
            f"Time was up before {join_names(late, _NAMED)} had filled the trial gaps that the "
            "others filled: a larger --budget may find a better model among them."
        )


def _with_bands(filled: Filled) -> str:
    """Return the best model with bands that trials cannot tell apart from the choice."""
    if filled.choice is None or filled.failed:
        return ""
    ranking = filled.choice.ranking
    alike = [model for model in ranking.rivals if ranking.scores[model].has_bands]
    return f"Trials cannot tell it apart from {alike[0]}, which has bands." if alike else ""


def _windows(count: int) -> str:
    one = "a window around the gap"
    return one if count == 1 else f"{count} windows around the gaps, each on its own"
