"""Filling: the entries of one file, by a model that is named or chosen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.baselines import Interpolator
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.able import able_models, require_able
from mocapbench.benchmark.filling.attempt import Attempt
from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion
from mocapbench.benchmark.filling.sources import Source
from mocapbench.benchmark.filling.trials.choice import NoneInTimeError, choose
from mocapbench.benchmark.filling.trials.comparison import Choice
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import Recording

__all__ = ["BEST", "Filled", "fill"]

BEST = "best"
"""In place of a model's name: the one that does best in trials."""

_LONGEST = 3600.0
"""Seconds after which a model is stopped that fills the file itself."""


@dataclass(frozen=True, eq=False)
class Filled:
    """A file whose gaps are filled.

    Parameters
    ----------
    source : Source
    model : str
        What filled it.
    answer : FilledEntries
    windows : int
        How many windows it was cut into; 0 if it was not.
    choice : Choice or None
        By which trials the model was chosen; None if it was named.
    failed : tuple of (str, str)
        Models that did better in trials and failed here, each with the reason.
    uncompared : bool
        Whether no model filled a trial gap in time, so that there was none to choose.
    """

    source: Source
    model: str
    answer: FilledEntries
    windows: int
    choice: Choice | None
    failed: tuple[tuple[str, str], ...]
    uncompared: bool = False

    @property
    def recording(self) -> Recording:
        """The recording with the filled entries; others may still be hidden."""
        request = self.source.request
        values = request.given.values.copy()
        values[request.target] = self.answer.mean
        return request.given.with_values(values)

    @property
    def deviations(self) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        """The standard deviation of each filled entry (M,); NaN where the model has none."""
        if self.answer.variance is None:
            return np.full(len(self.answer.mean), np.nan)
        return np.sqrt(self.answer.variance)


def fill(
    source: Source, model: str, workers: Workers, budget: float, watch: Callable[[int, int], object]
) -> Filled:
    """Return a file, filled.

    If no model fills a trial gap within the budget, an interpolation fills the file.

    Parameters
    ----------
    source : Source
    model : str
        A registered name, or `BEST`.
    workers : Workers
    budget : float
        Seconds for trials.
    watch : callable
        Called with the number of trials done and the total.

    Raises
    ------
    UsageError
        If the model cannot fill these gaps, or fails to.
    """
    question = source.question
    if model != BEST:
        require_able(model, question)
        return _filled(source, (model,), None, workers)
    try:
        choice = choose(question, workers, budget, watch)
    except NoneInTimeError:
        filled = _filled(source, _interpolations(question), None, workers)
        return replace(filled, uncompared=True)
    return _filled(source, choice.ranking.order, choice, workers)


def _interpolations(question: GapQuestion) -> tuple[str, ...]:
    """Return the models that interpolate, of which linear interpolation cannot overshoot."""
    able = [n for n in able_models(question) if issubclass(MODELS.get(n), Interpolator)]
    return tuple(sorted(able, key=lambda name: name != "linear"))


def _filled(
    source: Source, models: Sequence[str], choice: Choice | None, workers: Workers
) -> Filled:
    """Have the first of the models fill the file that can."""
    failed: list[tuple[str, str]] = []
    question = source.question
    for model in models:
        attempt = _attempt(model, question, workers)
        if attempt.answer is not None:
            return Filled(source, model, attempt.answer, attempt.windows, choice, tuple(failed))
        failed.append((model, attempt.trouble))
    name, trouble = failed[0]
    raise UsageError(f"{source.path}: {name} did not fill it: {trouble}; choose another --model")


def _attempt(model: str, question: GapQuestion, workers: Workers) -> Attempt:
    future = workers.submit(model, workers.keep(question), _LONGEST)
    workers.ended([future])
    return workers.result(future)
