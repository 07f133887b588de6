"""Filling the gaps of a recording, by models that are named or chosen."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array, Index
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.arrangement import arrange, arrange_entries, restore_entries
from mocapbench.benchmark.filling.candidates import require_candidate
from mocapbench.benchmark.filling.choosing.choice import Choice, choose, require_room
from mocapbench.benchmark.filling.choosing.kinds import Kind, tell_kinds
from mocapbench.benchmark.filling.costs import predict_calibrated_seconds
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest
from mocapbench.benchmark.filling.workers import FillBackend
from mocapbench.datasets import Mask, Recording

__all__ = ["FilledRecording", "fill", "require_fillable"]


@dataclass(frozen=True, eq=False)
class FilledRecording:
    """A recording whose gaps are filled.

    Parameters
    ----------
    request : FillRequest
        Without entries that stay open by the user's hand.
    prediction : PredictedEntries
        Of the entries that were to be filled, in the order of ``np.nonzero(request.target)``.
    models : ndarray of str of shape (M,)
        What filled each of them.
    kinds : ndarray of int of shape (M,)
        Of which kind each is, a number in ``all_kinds``.
    all_kinds : tuple of Kind
        The kinds of gaps.
    choice : Choice or None
        How models were chosen; None if all are named.
    failed : mapping of str to str
        Models that did better in held-out gaps and failed here, and why.
    n_windows : mapping of str to int
        Into how many windows models had the recording cut; 0 if into none.
    stopped : tuple of str
        Models that exceeded a limit of time or memory, as they may not on another machine.
    """

    request: FillRequest
    prediction: PredictedEntries
    models: NDArray[np.str_]
    kinds: Index
    all_kinds: tuple[Kind, ...]
    choice: Choice | None
    failed: Mapping[str, str]
    n_windows: Mapping[str, int]
    stopped: tuple[str, ...] = ()

    @cached_property
    def recording(self) -> Recording:
        """The recording with the filled entries; others may still be hidden."""
        values = self.request.given.values.copy()
        values[self.request.target] = self.prediction.mean
        return self.request.given.with_values(values)

    @property
    def used(self) -> tuple[str, ...]:
        """The models that filled entries, that which filled most of them first."""
        names, counts = np.unique(self.models, return_counts=True)
        return tuple(names[np.argsort(-counts, kind="stable")].tolist())

    @property
    def std(self) -> Array:
        """The standard deviation of each filled entry (M,); NaN where the model has none."""
        if self.prediction.variance is None:
            return np.full(len(self.prediction.mean), np.nan)
        return np.asarray(np.sqrt(self.prediction.variance))


def fill(
    request: FillRequest, workers: FillBackend, effort: str, watch: Callable[[int, int], object]
) -> FilledRecording:
    """Return a recording, filled.

    Parameters
    ----------
    request : FillRequest
    workers : FillBackend
    effort : str
        How much work the choice among models may take, see `choose`.
    watch : callable
        Called with the number of hold-outs that models have filled and the total so far.

    Raises
    ------
    UsageError
        If a named model cannot fill these gaps, or fails to.
    """
    problem, order = arrange(request.problem)
    named, kept = (arrange_entries(each, problem, order) for each in (request.models, request.kept))
    for name in sorted({*named[kept].tolist()} - {BEST}):
        require_candidate(name, problem)
    # What stays open by the user's hand is a part of the problem, so that it changes nothing else.
    choice = choose(problem, workers, effort, watch) if BEST in named[kept] else None
    all_kinds, kinds = _number_kinds(problem)
    plan = list(_plan_models(named, kept, all_kinds, kinds, choice))
    work = choice.work if choice else np.inf
    attempts = _attempt_best_first(problem, [each for _, each in plan], workers, work)
    models = np.full(named.shape, "", object)
    for entries, candidates in plan:
        models[entries] = _find_first(candidates, attempts)
    mean, variance = _take_predictions(models, attempts)
    mean, variance, models, kinds = (
        restore_entries(each, problem, order)[request.kept]
        for each in (mean, variance, models, kinds)
    )
    return FilledRecording(
        request.drop_left(),
        PredictedEntries(mean, None if np.isnan(variance).all() else variance),
        models.astype(str),
        kinds,
        all_kinds,
        choice,
        {model: one.failure for model, one in attempts.items() if one.prediction is None},
        {model: one.n_windows for model, one in attempts.items()},
        _find_stopped(choice, attempts),
    )


def require_fillable(request: FillRequest, seed: int) -> None:
    """Refuse what named models cannot fill, or what no model can be chosen for.

    Raises
    ------
    UsageError
        The message says what to do.
    """
    problem, _ = arrange(request.problem)
    models = {*request.models[request.kept].tolist()}
    for name in sorted(models - {BEST}):
        require_candidate(name, problem)
    if BEST in models:
        require_room(problem, seed)


def _number_kinds(problem: GapProblem) -> tuple[tuple[Kind, ...], Index]:
    """Return the kinds of gaps, and the number of that of each wanted entry (M,)."""
    by_gap = tell_kinds(problem)
    all_kinds = tuple(sorted({kind for kinds in by_gap.values() for kind in kinds}))
    numbers = np.zeros(problem.target.shape, dtype=np.int32)
    for gap, kinds in by_gap.items():
        for kind, channels in kinds.items():
            numbers[gap.start : gap.stop, list(channels)] = all_kinds.index(kind)
    return all_kinds, numbers[problem.target].astype(np.intp)


def _plan_models(
    named: NDArray[np.str_],
    kept: Mask,
    all_kinds: Sequence[Kind],
    kinds: Index,
    choice: Choice | None,
) -> Iterator[tuple[Index, tuple[str, ...]]]:
    """Yield kept entries that are filled alike, with the models that may fill them in order."""
    names, of_name = np.unique(named, return_inverse=True)
    together = np.where(kept, kinds * len(names) + of_name, -1)
    for number in np.unique(together[kept]).tolist():
        entries, (kind, name) = np.flatnonzero(together == number), divmod(number, len(names))
        if choice is not None and names[name] == BEST:
            yield entries, choice.find_ranking(all_kinds[kind]).order
        else:
            yield entries, (str(names[name]),)


def _attempt_best_first(
    problem: GapProblem, candidates: Sequence[Sequence[str]], workers: FillBackend, work: float
) -> dict[str, FillAttempt]:
    """Have the first of each sequence of candidates fill the problem, or else the next.

    Intervals are calibrated where that takes no more work than is allowed.
    """
    attempts: dict[str, FillAttempt] = {}
    path = workers.keep(problem)
    while models := {_find_first(each, attempts) for each in candidates} - attempts.keys():
        futures = {}
        for model in sorted(models):
            seconds = predict_calibrated_seconds(model, problem)
            method = "impute" if seconds <= work else "impute_uncalibrated"
            futures[workers.submit(model, path, seconds, method)] = model
        ended = workers.collect(futures.keys())
        attempts |= {model: ended[future] for future, model in futures.items()}
    return attempts


def _find_first(candidates: Sequence[str], attempts: Mapping[str, FillAttempt]) -> str:
    """Return the first candidate that has not failed."""
    for model in candidates:
        if model not in attempts or attempts[model].prediction is not None:
            return model
    first = candidates[0]
    raise UsageError(f"{first} did not fill it: {attempts[first].failure}; choose another --model")


def _find_stopped(choice: Choice | None, attempts: Mapping[str, FillAttempt]) -> tuple[str, ...]:
    here = {model for model, attempt in attempts.items() if attempt.stopped}
    return tuple(sorted({*(choice.stopped if choice else ()), *here}))


def _take_predictions(
    models: NDArray[Any], attempts: Mapping[str, FillAttempt]
) -> tuple[Array, Array]:
    """Return the mean and the variance of each entry (M,), NaN where its model has none."""
    mean, variance = np.empty(models.shape), np.full(models.shape, np.nan)
    for model, attempt in attempts.items():
        of_model = models == model
        if attempt.prediction is not None:
            mean[of_model] = attempt.prediction.mean[of_model]
            if attempt.prediction.variance is not None:
                variance[of_model] = attempt.prediction.variance[of_model]
    return mean, variance
