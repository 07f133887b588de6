"""Which models fill how many hold-outs, by counted work.

As in successive halving (Jamieson and Talwalkar 2016, *AISTATS*, PMLR 51:240–248), all models fill
a few hold-outs, and those that may still be the best fill twice as many, again and again. A model
is out if it errs more than the best one of every kind of gap by more than chance, as a paired test
finds. Work is predicted, not timed: on any machine, busy or idle, the same models fill the same
hold-outs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.ranking import Ranking, number_positions, rank
from mocapbench.benchmark.filling.choosing.scores import list_gaps, score_gaps, weigh_gaps
from mocapbench.benchmark.filling.costs import predict_seconds
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.workers import FillBackend

__all__ = ["Contender", "rank_by_kind", "run_rungs"]

_RUNGS = (2, 4, 8, 16)
"""After how many hold-outs models are compared, before they have filled all."""
_AT_FIRST = 0.75
"""Of the work, what the first hold-outs of all models may take."""


@dataclass(eq=False)
class Contender:
    """A model, and how it filled hold-outs.

    Parameters
    ----------
    model : str
    predictions : list of PredictedEntries
        Those of the first hold-outs, in order; none of a model that failed in one.
    ending : str
        Why it has no more of them.
    stopped : bool
        Whether an attempt exceeded a limit of time or memory, which another machine may not.
    n_windows : int
        Into how many windows it had the longest hold-out cut; 0 if into none.
    """

    model: str
    predictions: list[PredictedEntries] = field(default_factory=list)
    ending: str = ""
    stopped: bool = False
    n_windows: int = 0

    def record(self, attempts: Sequence[FillAttempt]) -> None:
        """Record the attempts at the next hold-outs; if one failed, no other counts."""
        for attempt in attempts:
            self.n_windows = max(self.n_windows, attempt.n_windows)
            self.stopped |= attempt.stopped
            if attempt.prediction is None:
                self.ending = attempt.failure
                self.predictions.clear()
                return
            self.predictions.append(attempt.prediction)


def run_rungs(
    models: Sequence[str],
    hold_outs: Sequence[HoldOut],
    workers: FillBackend,
    work: float,
    watch: Callable[[int, int], object],
) -> list[Contender]:
    """Return what each model predicted, in the order of models.

    Parameters
    ----------
    models : sequence of str
        The most promising first: of those whose work is too much beside others, they are in.
    hold_outs : sequence of HoldOut
    workers : FillBackend
    work : float
        Seconds of a core, as predicted, that all fits together may take.
    watch : callable
        Called with the number of hold-outs that models have filled and the total so far.
    """
    contenders = [Contender(model) for model in models]
    going, left, start = contenders, work, 0
    for stop in _list_rungs(hold_outs):
        costs = _predict_costs(going, hold_outs[start:stop])
        costs = _shorten(costs, left) if start else _afford(costs, _AT_FIRST * left)
        rung = hold_outs[start : start + min(map(len, costs.values()), default=0)]
        if not rung:
            break
        left -= sum(map(sum, costs.values()))
        _fill_rung(costs, rung, workers, watch)
        start += len(rung)
        rankings = rank_by_kind([*costs], hold_outs[:start])
        going = _drop_worse([*costs], rankings)
        if start < stop or all(len(_find_best(one)) == 1 for one in rankings.values()):
            break
    return contenders


def _list_rungs(hold_outs: Sequence[HoldOut]) -> list[int]:
    """Return how many hold-outs are filled after each rung; after the first, some of every kind.

    Otherwise models were dropped that are the best of another kind.
    """
    first: dict[Kind, int] = {}
    for number, hold_out in enumerate(hold_outs, start=1):
        for gap in hold_out.gaps:
            first.setdefault(gap.kind, number)
    least, n = max(first.values()), len(hold_outs)
    return sorted({min(max(stop, least), n) for stop in (*_RUNGS, n)})


def _predict_costs(
    going: Sequence[Contender], rung: Sequence[HoldOut]
) -> dict[Contender, Sequence[float]]:
    """Return the seconds of work that each hold-out of a rung takes each contender."""
    # One hold-out after another, since finding its sizes takes longer than all predictions.
    costs = [[predict_seconds(one.model, each.problem) for one in going] for each in rung]
    return dict(zip(going, map(list, zip(*costs, strict=True)), strict=True))


def _afford(
    costs: Mapping[Contender, Sequence[float]], work: float
) -> dict[Contender, Sequence[float]]:
    """Return those of which there is work for a first rung, in turn, with their costs."""
    able, spent = {}, 0.0
    for one, of_one in costs.items():
        if spent + sum(of_one) <= work:
            able[one] = of_one
            spent += sum(of_one)
        else:
            one.ending = f"would take {sum(of_one):.2g} s of work, more than --effort leaves"
    return able


def _shorten(
    costs: Mapping[Contender, Sequence[float]], work: float
) -> dict[Contender, Sequence[float]]:
    """Return the costs of as many hold-outs as there is work for, by all contenders."""
    spent = np.cumsum(np.sum([*costs.values()], axis=0))
    n = int(np.searchsorted(spent, work, side="right"))
    return {one: of_one[:n] for one, of_one in costs.items()}


def _fill_rung(
    costs: Mapping[Contender, Sequence[float]],
    rung: Sequence[HoldOut],
    workers: FillBackend,
    watch: Callable[[int, int], object],
) -> None:
    """Have contenders fill all hold-outs of a rung, each of which takes so many seconds of work."""
    problems = [workers.keep(hold_out.problem) for hold_out in rung]
    futures = {
        workers.submit(one.model, problem, seconds, "impute_uncalibrated"): one
        for one, of_one in costs.items()
        for problem, seconds in zip(problems, of_one, strict=True)
    }
    attempts = workers.collect(futures.keys(), watch)
    for one in costs:
        one.record([attempts[future] for future, owner in futures.items() if owner is one])


def rank_by_kind(
    contenders: Sequence[Contender], hold_outs: Sequence[HoldOut]
) -> dict[Kind, Ranking]:
    """Return the ranking of the contenders that filled all hold-outs, for each kind of gap."""
    gaps = list_gaps(hold_outs)
    able = [one for one in contenders if len(one.predictions) >= len(hold_outs)]
    if not able:
        return {}
    errors = {one.model: score_gaps(hold_outs, one.predictions) for one in able}
    rankings = {}
    for kind in sorted({gap.kind for gap in gaps}):
        which = np.array([gap.kind == kind for gap in gaps])
        of_kind = [gap for gap in gaps if gap.kind == kind]
        by_model = {model: each[which] for model, each in errors.items()}
        rankings[kind] = rank(by_model, weigh_gaps(of_kind), number_positions(of_kind))
    return rankings


def _find_best(ranking: Ranking) -> tuple[str, ...]:
    """Return the models that may be the best: by the test, or of too few gaps by their errors."""
    return ranking.sharing if ranking.tested else ranking.near


def _drop_worse(going: Sequence[Contender], rankings: Mapping[Kind, Ranking]) -> list[Contender]:
    """Return those that may be the best of a kind of gap, the most promising first."""
    kept = {model for ranking in rankings.values() for model in _find_best(ranking)}
    ratios = _rate([*rankings.values()])
    for one in going:
        if one.model in ratios and one.model not in kept:
            one.ending = (
                f"erred {ratios[one.model]:.3g} times as far as the best in "
                f"{format_count(len(one.predictions), 'hold-out')}, by more than chance"
            )
    return sorted((one for one in going if one.model in kept), key=lambda one: ratios[one.model])


def _rate(rankings: Sequence[Ranking]) -> Mapping[str, float]:
    """Return the mean error of each model relative to the best of each kind."""
    ratios = pd.DataFrame([one.means for one in rankings])
    return {str(m): float(r) for m, r in ratios.div(ratios.min(axis=1), axis=0).mean().items()}
