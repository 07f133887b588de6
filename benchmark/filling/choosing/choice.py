"""The choice of a model for each kind of gap, by errors in held-out gaps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.special import ndtri

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates
from mocapbench.benchmark.filling.choosing.halving import Contender, rank_by_kind, run_rungs
from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut, has_room, make_hold_outs
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.ranking import Ranking, share_evidence
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.costs import predict_calibrated_seconds, predict_seconds
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.workers import FillBackend
from mocapbench.datasets import Mask

__all__ = ["EFFORTS", "Choice", "choose", "require_room"]

EFFORTS: Mapping[str, tuple[float, float]] = {
    "low": (3.5, 0.25),
    "normal": (14.0, 1.0),
    "high": (140.0, 10.0),
}
"""How much work, predicted in seconds of a core, a choice may take: so much, and so much more for
each 100,000 entries of the recording."""
_PER_ENTRIES = 100_000
_WITHIN_95 = float(ndtri(0.975))
_CHECKED = 3
"""Hold-outs filled again with intervals, besides the first with each kind of gap: calibration takes
several times longer."""


@dataclass(frozen=True, eq=False)
class Choice:
    """How models did in held-out gaps.

    Parameters
    ----------
    rankings : mapping of Kind to Ranking
        Of the models that filled all hold-outs, for each kind of gap of which there are copies.
    hold_outs : tuple of HoldOut
        Those that the ranked models filled.
    contenders : tuple of Contender
        All models that were compared.
    work : float
        Seconds of a core, as predicted, that the choice and each model's fill may take.
    too_dear : tuple of str
        Models that were left out beforehand, since they would take more.
    with_intervals : frozenset of str
        The ranked models that have a predictive distribution.
    in_intervals : mapping of Kind to ndarray of bool of shape (n,)
        Of hidden entries of held-out gaps, which are in the 95 % intervals of the first model.
        A kind whose first model has none is absent.
    """

    rankings: Mapping[Kind, Ranking]
    hold_outs: tuple[HoldOut, ...]
    contenders: tuple[Contender, ...]
    work: float = np.inf
    too_dear: tuple[str, ...] = ()
    with_intervals: frozenset[str] = frozenset()
    in_intervals: Mapping[Kind, Mask] = field(default_factory=dict)

    def find_ranking(self, kind: Kind) -> Ranking:
        """Return the ranking for a kind, or for the one most like it of which there are copies."""
        return self.rankings[min(self.rankings, key=lambda other: _measure_unlikeness(other, kind))]

    @property
    def stopped(self) -> tuple[str, ...]:
        """The models that exceeded a limit: on another machine, the choice may differ."""
        return tuple(one.model for one in self.contenders if one.stopped)

    @property
    def shares(self) -> Mapping[Kind, float]:
        """Of each kind, the length of the shortest held-out gap relative to the real one."""
        shares: dict[Kind, float] = {}
        for gap in list_gaps(self.hold_outs):
            share = len(gap.copy) / len(gap.original)
            shares[gap.kind] = min(share, shares.get(gap.kind, 1.0))
        return shares


def _measure_unlikeness(other: Kind, kind: Kind) -> tuple[bool, bool, bool, Kind]:
    return other.unit != kind.unit, other.extent != kind.extent, other.length != kind.length, other


def choose(
    problem: GapProblem, workers: FillBackend, effort: str, watch: Callable[[int, int], object]
) -> Choice:
    """Return which model fills each kind of gap of a problem best.

    Parameters
    ----------
    problem : GapProblem
    workers : FillBackend
    effort : str
        One of `EFFORTS`.
    watch : callable
        Called with the number of hold-outs that models have filled and the total so far.

    Raises
    ------
    UsageError
        If there is no room for a hold-out, or no model fills one.
    """
    hold_outs = make_hold_outs(problem, np.random.default_rng(workers.seed))
    if not hold_outs:
        raise _explain_no_room(problem)
    work = _allow_work(problem, effort)
    models = find_candidates(problem)
    able = [model for model in models if predict_seconds(model, problem) <= work]
    if not able:
        raise UsageError(
            f"expected a model that takes no more work than --effort {effort} allows, got none; "
            f"raise --effort, or name a model with --model: {', '.join(models)}"
        )
    contenders = run_rungs(able, hold_outs, workers, work, watch)
    n_filled = max(len(one.predictions) for one in contenders)
    if not n_filled:
        raise UsageError(
            f"expected a model that fills a held-out gap, got none ({contenders[0].model}: "
            f"{contenders[0].ending}); name a model with --model"
        )
    filled = tuple(hold_outs[:n_filled])
    choice = Choice(
        _share_evidence_by_unit(rank_by_kind(contenders, filled)),
        filled,
        tuple(contenders),
        work,
        tuple(model for model in models if model not in able),
        _find_those_with_intervals(contenders, n_filled),
    )
    return replace(choice, in_intervals=check_intervals(choice, workers))


def _share_evidence_by_unit(rankings: Mapping[Kind, Ranking]) -> dict[Kind, Ranking]:
    """Return the rankings, to each of which all kinds of its unit contribute."""
    return {
        kind: share_evidence(own, [one for k, one in rankings.items() if k.unit == kind.unit])
        for kind, own in rankings.items()
    }


def _allow_work(problem: GapProblem, effort: str) -> float:
    """Return how many seconds of a core the fits of a choice may take, as predicted."""
    once, per_entries = EFFORTS[effort]
    return once + per_entries * problem.target.size / _PER_ENTRIES


def _find_those_with_intervals(contenders: Sequence[Contender], n_filled: int) -> frozenset[str]:
    ranked = [one for one in contenders if len(one.predictions) == n_filled]
    return frozenset(
        one.model for one in ranked if all(each.variance is not None for each in one.predictions)
    )


def require_room(problem: GapProblem, seed: int) -> None:
    """Refuse a recording in which no copy of a gap can be held out.

    Raises
    ------
    UsageError
        The message says what to do.
    """
    if not has_room(problem, np.random.default_rng(seed)):
        raise _explain_no_room(problem)


def _explain_no_room(problem: GapProblem) -> UsageError:
    """Return what is wrong, and how to go on where no recording can tell which model to take."""
    models = find_candidates(problem)
    advice = f"name a model with --model: {', '.join(models)}"
    if len(problem.train) > 1 and "best-of" in models:
        advice += "; best-of tries others on the files of --train"
    return UsageError(
        f"expected a visible stretch to try models on, got none that is free of gaps; {advice}"
    )


def check_intervals(choice: Choice, workers: FillBackend) -> dict[Kind, Mask]:
    """Return which hidden entries are in the intervals of the first model of each kind.

    Of a model of which that would take more work, nothing is checked.
    """
    firsts = {kind: one.order[0] for kind, one in choice.rankings.items()}
    checked = _find_to_check(choice.hold_outs)
    kept = [workers.keep(one.problem) for one in checked]
    futures = {}
    for model in sorted({*firsts.values()} & choice.with_intervals):
        seconds = [predict_calibrated_seconds(model, one.problem) for one in checked]
        if sum(seconds) <= choice.work:
            for one, problem, each in zip(checked, kept, seconds, strict=True):
                futures[workers.submit(model, problem, each)] = model, one
    inside: dict[Kind, list[Mask]] = {}
    attempts = workers.collect(futures.keys())
    for future, (model, one) in futures.items():
        for kind, entries in _list_entries_inside(one, attempts[future]):
            if firsts[kind] == model:
                inside.setdefault(kind, []).append(entries)
    return {kind: np.concatenate(each) for kind, each in inside.items()}


def _find_to_check(hold_outs: Sequence[HoldOut]) -> list[HoldOut]:
    """Return the first hold-outs, and others that have the first gaps of a kind."""
    found: list[HoldOut] = []
    seen: set[Kind] = set()
    for hold_out in hold_outs:
        kinds = {gap.kind for gap in hold_out.gaps}
        if len(found) < _CHECKED or not kinds <= seen:
            found.append(hold_out)
            seen |= kinds
    return found


def _list_entries_inside(hold_out: HoldOut, attempt: FillAttempt) -> Iterator[tuple[Kind, Mask]]:
    """Yield which entries of each held-out gap are in the 95 % intervals, if there are any."""
    prediction = attempt.prediction
    if prediction is not None and prediction.variance is not None:
        errors: Array = np.abs(prediction.mean - hold_out.truth)
        inside = errors <= _WITHIN_95 * np.sqrt(prediction.variance)
        yield from ((gap.kind, inside[gap.entries]) for gap in hold_out.gaps)
