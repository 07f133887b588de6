"""The choice of a model by its errors in held-out gaps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import ndtri

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates
from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut, has_room, make_hold_outs
from mocapbench.benchmark.filling.choosing.ranking import Ranking, number_positions, rank
from mocapbench.benchmark.filling.choosing.schedule import Contender, run_rounds
from mocapbench.benchmark.filling.choosing.scores import (
    score_gaps,
    score_holding,
    score_units,
    weigh_gaps,
)
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import Mask

__all__ = ["Choice", "NoneInTimeError", "check_intervals", "choose", "compare", "require_room"]

_SEED = 0
_FOR_INTERVALS = 0.5
"""Of the budget, what the check of intervals may take besides."""
_WITHIN_95 = float(ndtri(0.975))
_CHECKED = 3
"""Hold-outs filled again with intervals, the first ones: calibration takes several times longer."""


class NoneInTimeError(UsageError):
    """No model filled a hold-out within its part of the budget."""


@dataclass(frozen=True, eq=False)
class Choice:
    """How models did in held-out gaps.

    Parameters
    ----------
    ranking : Ranking
        Of the models that filled the same hold-outs.
    left_out : tuple of Contender
        The others.
    share : float
        The length of the shortest held-out gap relative to the real one.
    rmse : mapping of str to mapping of str to float
        Of each ranked model, by unit: the root mean squared error over all entries, in that unit.
    with_intervals : frozenset of str
        The ranked models that have a predictive distribution.
    seconds : mapping of str to float
        What a hold-out took each ranked model on average.
    n_windows : mapping of str to int
        Into how many windows each ranked model had a hold-out cut; 0 if into none.
    unused : int
        How many more hold-outs others filled than the first model had time for.
    in_intervals : tuple of ndarray of bool
        Of hidden entries of held-out gaps, which are in the 95 % intervals of the first model: an
        array a gap. There is none if the model has no intervals, or no time was left.
    """

    ranking: Ranking
    left_out: tuple[Contender, ...]
    share: float
    rmse: Mapping[str, Mapping[str, float]]
    with_intervals: frozenset[str]
    seconds: Mapping[str, float]
    n_windows: Mapping[str, int]
    unused: int = 0
    in_intervals: tuple[Mask, ...] = ()


def choose(
    problem: GapProblem, workers: Workers, budget: float, watch: Callable[[int, int], object]
) -> Choice:
    """Return which model fills gaps like those of a problem best.

    Parameters
    ----------
    problem : GapProblem
    workers : Workers
    budget : float
        Seconds to compare models; half as many more may go to the intervals of the best.
    watch : callable
        Called with the number of hold-outs that models have filled and the total.

    Raises
    ------
    NoneInTimeError
        If no model fills a hold-out within the budget.
    UsageError
        If there is no room for a hold-out.
    """
    models = find_candidates(problem)
    hold_outs = make_hold_outs(problem, np.random.default_rng(_SEED))
    if not hold_outs:
        raise _explain_no_room(problem)
    contenders = run_rounds(models, hold_outs, workers, budget, watch)
    if not any(contender.predictions for contender in contenders):
        raise NoneInTimeError(
            f"{problem.given.name}: expected a model that fills a held-out gap in its part of the "
            f"budget of {budget:g} s, got none ({contenders[0].model}: {contenders[0].failure}); "
            "raise --budget"
        )
    choice = compare(hold_outs, contenders)
    best = choice.ranking.order[0]
    if best not in choice.with_intervals:
        return choice
    seconds = _FOR_INTERVALS * budget
    return replace(choice, in_intervals=check_intervals(best, hold_outs, workers, seconds))


def require_room(problem: GapProblem) -> None:
    """Refuse a recording in which no copy of a gap can be held out.

    Raises
    ------
    UsageError
        The message says what to do.
    """
    if not has_room(problem, np.random.default_rng(_SEED)):
        raise _explain_no_room(problem)


def _explain_no_room(problem: GapProblem) -> UsageError:
    """Return what is wrong, and how to go on where no recording can tell which model to take."""
    models = find_candidates(problem)
    advice = f"name a model with --model: {', '.join(models)}"
    if len(problem.train) > 1 and "best-of" in models:
        advice += "; best-of tries others on the files of --train"
    return UsageError(
        f"{problem.given.name}: expected a visible stretch to try models on, got none that is "
        f"free of gaps; {advice}"
    )


def compare(hold_outs: Sequence[HoldOut], contenders: Sequence[Contender]) -> Choice:
    """Return the ranking by as many hold-outs as most of the predictions allow.

    A model that filled fewer of them is chosen by these, if it leads there by more than chance.

    Parameters
    ----------
    hold_outs : sequence of HoldOut
    contenders : sequence of Contender
        At least one has a prediction.
    """
    common = _count_common(contenders)
    most = _compare_over(hold_outs[:common], contenders)
    counts = {len(contender.predictions) for contender in contenders}
    n_most = max(counts)
    for count in sorted((n for n in counts if 0 < n < common), reverse=True):
        if _copy_the_same_gaps(hold_outs[:count], hold_outs[:n_most]):
            fewer = _compare_over(hold_outs[:count], contenders)
            by_hold_out = _rank_by_hold_out(hold_outs[:count], fewer.ranking)
            if _leads(fewer.ranking, most) and _leads(by_hold_out, most):
                return replace(fewer, unused=n_most - count)
    return most


def _count_common(contenders: Sequence[Contender]) -> int:
    """Return by how many of the first hold-outs to compare: those with most predictions in all."""
    counts = sorted((len(contender.predictions) for contender in contenders), reverse=True)
    totals = [count * n_models for n_models, count in enumerate(counts, start=1)]
    return counts[int(np.argmax(totals))]


def _copy_the_same_gaps(fewer: Sequence[HoldOut], more: Sequence[HoldOut]) -> bool:
    """Return whether fewer hold-outs have copies of all gaps of which more have some."""
    of_fewer, of_more = ({gap for one in each for gap in one.originals} for each in (fewer, more))
    return of_fewer == of_more


def _leads(ranking: Ranking, most: Choice) -> bool:
    """Return whether a model that most leaves out is better than all others by more than chance."""
    return ranking.tested and not {*most.ranking.order} & {*ranking.sharing}


def _rank_by_hold_out(hold_outs: Sequence[HoldOut], ranking: Ranking) -> Ranking:
    """Return the ranking with hold-outs as units: a fit makes all errors of one large or small."""
    number = np.repeat(np.arange(len(hold_outs)), [len(one.copies) for one in hold_outs])
    return rank(ranking.errors, weigh_gaps(hold_outs), number)


def _compare_over(hold_outs: Sequence[HoldOut], contenders: Sequence[Contender]) -> Choice:
    """Return the choice among the models that filled all of these hold-outs."""
    scales = score_holding(hold_outs)
    ranked = [one for one in contenders if len(one.predictions) >= len(hold_outs)]
    predicted = {one.model: one.predictions[: len(hold_outs)] for one in ranked}
    errors = {model: score_gaps(hold_outs, each, scales) for model, each in predicted.items()}
    return Choice(
        ranking=rank(errors, weigh_gaps(hold_outs), number_positions(hold_outs)),
        left_out=tuple(one for one in contenders if one not in ranked),
        share=min(hold_out.share for hold_out in hold_outs),
        rmse={model: score_units(hold_outs, each) for model, each in predicted.items()},
        with_intervals=frozenset(
            model
            for model, each in predicted.items()
            if all(prediction.variance is not None for prediction in each)
        ),
        seconds={one.model: one.seconds / len(one.predictions) for one in ranked},
        n_windows={one.model: one.n_windows for one in ranked},
    )


def check_intervals(
    model: str, hold_outs: Sequence[HoldOut], workers: Workers, seconds: float
) -> tuple[Mask, ...]:
    """Return which hidden entries are in a model's 95 % intervals, an array a held-out gap.

    There is none if no hold-out was filled in time.

    Parameters
    ----------
    model : str
    hold_outs : sequence of HoldOut
    workers : Workers
    seconds : float
        For all that is done here.
    """
    checked = hold_outs[:_CHECKED]
    share = seconds / np.ceil(len(checked) / workers.count)
    running = {
        workers.submit(model, workers.keep(one.problem), share, "impute"): one for one in checked
    }
    within: list[Mask] = []
    while running:
        for future in workers.wait_for_any(running.keys()):
            hold_out, prediction = running.pop(future), workers.collect(future).prediction
            if prediction is not None and prediction.variance is not None:
                errors = np.abs(prediction.mean - hold_out.truth)
                inside = errors <= _WITHIN_95 * np.sqrt(prediction.variance)
                within += [inside[entries] for entries in hold_out.entries]
    return tuple(within)
