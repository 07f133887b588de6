"""Filling the entries of one file, by a model that is named or chosen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates, require_candidate
from mocapbench.benchmark.filling.choosing.choice import Choice, NoneInTimeError, choose
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.registry import build_unfitted
from mocapbench.datasets import Recording

__all__ = ["BEST", "FilledFile", "fill"]

BEST = "best"
"""In place of a model's name: the one with the least error in held-out gaps."""

_LONGEST = 3600.0
"""Seconds after which a model is stopped that fills the file itself."""


@dataclass(frozen=True, eq=False)
class FilledFile:
    """A file whose gaps are filled.

    Parameters
    ----------
    input_file : InputFile
    model : str
        What filled it.
    prediction : PredictedEntries
    n_windows : int
        How many windows it was cut into; 0 if it was not.
    choice : Choice or None
        How the model was chosen; None if it was named.
    failed : tuple of (str, str)
        Models that did better in held-out gaps and failed here, each with the reason.
    uncompared : bool
        Whether no model filled a held-out gap in time, so that there was none to choose.
    """

    input_file: InputFile
    model: str
    prediction: PredictedEntries
    n_windows: int
    choice: Choice | None
    failed: tuple[tuple[str, str], ...]
    uncompared: bool = False

    @property
    def recording(self) -> Recording:
        """The recording with the filled entries; others may still be hidden."""
        request = self.input_file.request
        values = request.given.values.copy()
        values[request.target] = self.prediction.mean
        return request.given.with_values(values)

    @property
    def deviations(self) -> Array:
        """The standard deviation of each filled entry (M,); NaN where the model has none."""
        if self.prediction.variance is None:
            return np.full(len(self.prediction.mean), np.nan)
        return np.asarray(np.sqrt(self.prediction.variance))


def fill(
    input_file: InputFile,
    model: str,
    workers: Workers,
    budget: float,
    watch: Callable[[int, int], object],
) -> FilledFile:
    """Return a file, filled.

    If no model fills a held-out gap within the budget, an interpolation fills the file.

    Parameters
    ----------
    input_file : InputFile
    model : str
        A registered name, or `BEST`.
    workers : Workers
    budget : float
        Seconds to compare models.
    watch : callable
        Called with the number of hold-outs that models have filled and the total.

    Raises
    ------
    UsageError
        If the model cannot fill these gaps, or fails to.
    """
    problem = input_file.problem
    if model != BEST:
        require_candidate(model, problem)
        return _fill_by_first(input_file, (model,), None, workers)
    try:
        choice = choose(problem, workers, budget, watch)
    except NoneInTimeError:
        filled = _fill_by_first(input_file, _find_interpolations(problem), None, workers)
        return replace(filled, uncompared=True)
    return _fill_by_first(input_file, choice.ranking.order, choice, workers)


def _find_interpolations(problem: GapProblem) -> tuple[str, ...]:
    """Return the models that interpolate, of which linear interpolation cannot overshoot."""
    able = [n for n in find_candidates(problem) if "interpolates" in build_unfitted(n).provides]
    return tuple(sorted(able, key=lambda name: name != "linear"))


def _fill_by_first(
    input_file: InputFile, models: Sequence[str], choice: Choice | None, workers: Workers
) -> FilledFile:
    """Have the first of the models fill the file that can."""
    failed: list[tuple[str, str]] = []
    problem = input_file.problem
    for model in models:
        one = _attempt_file(model, problem, workers)
        if one.prediction is not None:
            return FilledFile(
                input_file, model, one.prediction, one.n_windows, choice, tuple(failed)
            )
        failed.append((model, one.failure))
    name, failure = failed[0]
    raise UsageError(
        f"{input_file.path}: {name} did not fill it: {failure}; choose another --model"
    )


def _attempt_file(model: str, problem: GapProblem, workers: Workers) -> FillAttempt:
    future = workers.submit(model, workers.keep(problem), _LONGEST)
    workers.wait_for_any([future])
    return workers.collect(future)
