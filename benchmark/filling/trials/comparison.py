"""Models compared over the same trials, and which trials these are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.benchmark.filling.trials.bands import Coverage
from mocapbench.benchmark.filling.trials.places import places_of
from mocapbench.benchmark.filling.trials.ranking import Ranking, rank
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.trials.scores import held_errors, scores_of, weights_of
from mocapbench.benchmark.filling.trials.trial import Trial

__all__ = ["Choice", "compared"]


@dataclass(frozen=True, eq=False)
class Choice:
    """How models did in trials.

    Parameters
    ----------
    ranking : Ranking
        Of the models that answered the same trials.
    left_out : tuple of Runner
        The others.
    share : float
        The length of the shortest trial gap relative to the real one.
    seconds : mapping of str to float
        What a trial took each ranked model on average.
    windows : mapping of str to int
        Into how many windows each ranked model had a trial cut; 0 if into none.
    unused : int
        How many more trials others had than the first model had time for.
    coverage : Coverage or None
        What the bands of the first model hold in trials; None if it has none, or no time was left.
    """

    ranking: Ranking
    left_out: tuple[Runner, ...]
    share: float
    seconds: Mapping[str, float]
    windows: Mapping[str, int]
    unused: int = 0
    coverage: Coverage | None = None


def compared(trials: Sequence[Trial], runners: Sequence[Runner]) -> Choice:
    """Return the ranking by as many trials as most of the answers allow.

    A model that had fewer of them is chosen by these, if it leads there by more than chance.

    Parameters
    ----------
    trials : sequence of Trial
    runners : sequence of Runner
        At least one has an answer.
    """
    common = _common(runners)
    most = _ranked(trials[:common], runners)
    n_most = max(len(runner.answers) for runner in runners)
    counts = {len(runner.answers) for runner in runners}
    for count in sorted((n for n in counts if 0 < n < common), reverse=True):
        if _of_all_gaps(trials[:count], trials[:n_most]):
            fewer = _ranked(trials[:count], runners)
            if _leads(fewer.ranking, most) and _leads(_by_trial(trials[:count], fewer), most):
                return replace(fewer, unused=n_most - count)
    return most


def _common(runners: Sequence[Runner]) -> int:
    """Return by how many of the first trials to compare: those with most answers in all."""
    counts = sorted((len(runner.answers) for runner in runners), reverse=True)
    totals = [count * place for place, count in enumerate(counts, start=1)]
    return counts[int(np.argmax(totals))]


def _of_all_gaps(fewer: Sequence[Trial], more: Sequence[Trial]) -> bool:
    """Return whether fewer trials have copies of all gaps of which more trials have some."""
    of_fewer, of_more = ({gap for t in trials for gap in t.originals} for trials in (fewer, more))
    return of_fewer == of_more


def _leads(ranking: Ranking, most: Choice) -> bool:
    """Return whether a model that most leaves out is better than all others by more than chance."""
    return ranking.tested and not most.ranking.scores.keys() & set(ranking.sharing)


def _by_trial(trials: Sequence[Trial], choice: Choice) -> Ranking:
    """Return the ranking with trials as units: a fit makes all errors of one large or small."""
    number = np.repeat(np.arange(len(trials)), [len(trial.units) for trial in trials])
    return rank(choice.ranking.scores, weights_of(trials), number)


def _ranked(trials: Sequence[Trial], runners: Sequence[Runner]) -> Choice:
    scales = held_errors(trials)
    scores = {
        runner.model: scores_of(trials, runner.answers[: len(trials)], scales)
        for runner in runners
        if len(runner.answers) >= len(trials)
    }
    return Choice(
        ranking=rank(scores, weights_of(trials), places_of(trials)),
        left_out=tuple(runner for runner in runners if runner.model not in scores),
        share=min(trial.share for trial in trials),
        seconds={r.model: r.seconds / len(r.answers) for r in runners if r.model in scores},
        windows={r.model: r.windows for r in runners if r.model in scores},
    )
