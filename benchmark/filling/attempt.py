"""One attempt: a model answers a question, in a process of its own."""

from __future__ import annotations

import resource
import sys
import warnings
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from traceback import extract_tb

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import FrameImputer, Prediction
from mocapbench.benchmark.filling.constants import keep_constants
from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion, without_unseen
from mocapbench.benchmark.filling.windows import Window, windows_of
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.runs.fitting.solve import build_model
from mocapbench.datasets import FrameByChannel

__all__ = ["Attempt", "attempt"]

_SEED = 0


@dataclass(frozen=True, eq=False)
class Attempt:
    """How an attempt ended.

    Parameters
    ----------
    answer : FilledEntries or None
        None if there is none.
    trouble : str
        Why not.
    windows : int
        How many windows the recording was cut into; 0 if it was not.
    seconds : float
        What it took.
    slow : bool
        Whether it was stopped because it took longer than allowed.
    """

    answer: FilledEntries | None
    trouble: str = ""
    windows: int = 0
    seconds: float = 0.0
    slow: bool = False

    def taking(self, seconds: float) -> Attempt:
        """Return the attempt with the seconds that it took."""
        return replace(self, seconds=seconds)


def attempt(
    model: type[FrameImputer], question: GapQuestion, memory: int, method: str = "impute"
) -> Attempt:
    """Return what a model answers; whatever it raises becomes its trouble.

    Parameters
    ----------
    model : type
        Built with its default parameters.
    question : GapQuestion
    memory : int
        Bytes of address space to which this process is limited from now on.
    method : str, default="impute"
        What the model is asked for: ``"as_claimed"`` are the same means, without the time that
        checks of variances take.
    """
    resource.setrlimit(resource.RLIMIT_AS, (memory, resource.RLIM_INFINITY))
    try:
        with warnings.catch_warnings(action="ignore"):
            windows = windows_of(question, model.max_frames)
            merged = _merge_windows(
                question, [(w, _filled(model, part, method)) for w, part in windows]
            )
            answer = keep_constants(question, merged)
    except MemoryError:
        return Attempt(None, f"needed more than {memory / 2**30:.1f} GiB of memory")
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        return Attempt(None, reason(error) + _place(error, model))
    whole = windows[0][0].stop - windows[0][0].first == len(question.given.times)
    return Attempt(answer, windows=0 if whole else len(windows))


def _place(error: BaseException, model: type[FrameImputer]) -> str:
    """Return the line of the model's own file where something went wrong; of ours, nothing."""
    if model.__module__.startswith("mocapbench."):
        return ""
    path = Path(getattr(sys.modules.get(model.__module__), "__file__", None) or "")
    lines = [f.lineno for f in extract_tb(error.__traceback__) if Path(f.filename) == path]
    return f" ({path.name}, line {lines[-1]})" if lines else ""


def _filled(model: type[FrameImputer], question: GapQuestion, method: str) -> Prediction:
    """Return what the model puts where the question's entries are wanted (N, D)."""
    asked = without_unseen(question)
    problem = ImputeProblem(
        train=(*asked.train, asked.given),
        given=(asked.given,),
        truth=(asked.given.values,),  # nobody scores here, and nobody knows it
        unit=Unit.natural(len(asked.given.channels)),
    )
    fitted = build_model(model, {}, _SEED)
    problem.fit(fitted)
    (prediction,) = problem.check_predictions(
        getattr(fitted, method)(problem.given), method
    ).predictions
    spread = partial(_over_channels, question, asked)
    variance = None if prediction.variance is None else spread(prediction.variance)
    return Prediction(spread(prediction.mean), variance)


def _over_channels(
    question: GapQuestion, asked: GapQuestion, values: FrameByChannel
) -> FrameByChannel:
    """Return values (N, d) of the channels asked for as (N, D), NaN in the others."""
    full = np.full(question.target.shape, np.nan)
    full[:, np.isin(question.given.channels, asked.given.channels)] = values
    return full


def _merge_windows(question: GapQuestion, parts: list[tuple[Window, Prediction]]) -> FilledEntries:
    """Return the wanted entries of all windows in the order of the question's."""
    means = [prediction.mean for _, prediction in parts]
    variances = [prediction.variance for _, prediction in parts if prediction.variance is not None]
    windows = [window for window, _ in parts]
    complete = len(variances) == len(means)
    return FilledEntries(
        _place_wanted(question, windows, means),
        _place_wanted(question, windows, variances) if complete else None,
    )


def _place_wanted(
    question: GapQuestion, windows: list[Window], values: list[FrameByChannel]
) -> NDArray[np.float64]:
    full = np.full(question.target.shape, np.nan)
    for window, part in zip(windows, values, strict=True):
        first, stop = window.wanted_first, window.wanted_stop
        full[first:stop] = part[first - window.first : stop - window.first]
    return full[question.target]
