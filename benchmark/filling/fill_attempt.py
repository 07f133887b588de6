"""One fill attempt: a model solves a problem, in a process of its own.

Channels that are constant wherever they are visible stay so where they are filled. The height of a
point on the floor, or an angle that a skeleton does not use, does not move in a gap either,
whatever a model makes of it.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from traceback import extract_tb
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from mocapbench.baselines import FrameImputer, Model
from mocapbench.basics.arrays import Array
from mocapbench.basics.child import LONGEST
from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.filling.gap_problem import (
    GapProblem,
    PredictedEntries,
    cut_windows,
    drop_unseen,
    pose_imputing,
)
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.runs.fitting.solve import build_model

__all__ = ["FillAttempt", "attempt_fill", "fill_problem", "keep_constants"]

_ENOUGH = 10
"""Frames; fewer that are equal are so by chance in files of rounded numbers, unless most are."""


@dataclass(frozen=True, eq=False)
class FillAttempt:
    """How an attempt ended.

    Parameters
    ----------
    prediction : PredictedEntries or None
        None if the attempt failed.
    failure : str
        Why it did.
    n_windows : int
        How many windows the recording was cut into; 0 if it was not.
    stopped : bool
        Whether it exceeded a limit of time or memory, which it may not on another machine.
    """

    prediction: PredictedEntries | None
    failure: str = ""
    n_windows: int = 0
    stopped: bool = False


def attempt_fill(
    model: type[FrameImputer],
    problem: GapProblem,
    memory: int,
    *,
    seconds: float = LONGEST,
    seed: int = 0,
    method: str = "impute",
    calibration: Callable[[Any], Model] | None = None,
) -> FillAttempt:
    """Return what a model predicts; whatever it raises becomes the failure of the attempt.

    Parameters
    ----------
    model : type
        Built with its default parameters.
    problem : GapProblem
    memory : int
        Bytes of address space to which this process is limited from now on.
    seconds : float, optional
        Of processor time, after which the system ends this process.
    seed : int, default=0
        Of what the model draws at random.
    method : str, default="impute"
        What the model is asked for: ``"impute_uncalibrated"`` has the same means, without the time
        that calibrating variances takes.
    calibration : callable, optional
        What calibrates the model.
    """
    find_system().limit_memory(memory)
    find_system().limit_work(seconds)
    # There are as many attempts as cores: more threads would wait for each other.
    threadpool_limits(limits=1)
    try:
        return fill_problem(partial(build_model, model, {}, seed, calibration), problem, method)
    except MemoryError as error:
        said = f" ({error})" if str(error) else ""
        needed = f"needed more than {memory / 2**30:.1f} GiB of memory{said}"
        return FillAttempt(None, needed, stopped=True)
    except TimeoutError as error:  # of a program that the model has run
        return FillAttempt(None, str(error), stopped=True)
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        return FillAttempt(None, reason(error) + _locate_error(error, model))


def fill_problem(
    build: Callable[[], Any], problem: GapProblem, method: str = "impute"
) -> FillAttempt:
    """Return what a model predicts, in windows if the recording is too long for it.

    Parameters
    ----------
    build : callable
        Returns the model, not fitted.
    problem : GapProblem
    method : str, default="impute"
        As for `attempt_fill`.
    """
    with warnings.catch_warnings(action="ignore"):
        windows = cut_windows(problem, build().max_frames)
        parts = [(frames, part, _predict(build, part, method)) for frames, part in windows]
    prediction = keep_constants(problem, _merge_windows(problem, parts))
    whole = windows[0][0] == slice(0, len(problem.given.times))
    return FillAttempt(prediction, n_windows=0 if whole else len(windows))


def _locate_error(error: BaseException, model: type[FrameImputer]) -> str:
    """Return the line of the model's own file where something went wrong; of ours, nothing."""
    if model.__module__.startswith("mocapbench."):
        return ""
    path = Path(getattr(sys.modules.get(model.__module__), "__file__", None) or "")
    lines = [f.lineno for f in extract_tb(error.__traceback__) if Path(f.filename) == path]
    return f" ({path.name}, line {lines[-1]})" if lines else ""


def _predict(build: Callable[[], Any], problem: GapProblem, method: str) -> PredictedEntries:
    """Return what the model predicts of the wanted entries."""
    seen = drop_unseen(problem)  # of what is wanted it drops nothing
    imputing = pose_imputing(seen)
    fitted = build()
    imputing.fit(fitted)
    (prediction,) = imputing.check_predictions(getattr(fitted, method)(imputing.given), method)
    variance = None if prediction.variance is None else prediction.variance[seen.target]
    return PredictedEntries(prediction.mean[seen.target], variance)


def _merge_windows(
    problem: GapProblem, parts: list[tuple[slice, GapProblem, PredictedEntries]]
) -> PredictedEntries:
    """Return the wanted entries of all windows, in the order of those of the whole problem."""
    if len(parts) == 1:
        return parts[0][2]
    mean, variance = (np.full(problem.target.shape, np.nan) for _ in range(2))
    has_variance = all(prediction.variance is not None for _, _, prediction in parts)
    for frames, part, prediction in parts:
        mean[frames][part.target] = prediction.mean
        if prediction.variance is not None:
            variance[frames][part.target] = prediction.variance
    target = problem.target
    return PredictedEntries(mean[target], variance[target] if has_variance else None)


def keep_constants(problem: GapProblem, prediction: PredictedEntries) -> PredictedEntries:
    """Return the predicted entries, those of a channel that is constant where visible as constant.

    Their variances stay those of the model.
    """
    _, channels = np.nonzero(problem.target)
    kept = _find_constants(problem)[channels]
    return replace(prediction, mean=np.where(np.isnan(kept), prediction.mean, kept))


def _find_constants(problem: GapProblem) -> Array:
    """Return the one value of each channel (D,) in all recordings, NaN where it has others."""
    values = [recording.values for recording in (problem.given, *problem.train)]
    highest = np.fmax.reduce([np.fmax.reduce(one, axis=0) for one in values])  # ignores NaN
    lowest = np.fmin.reduce([np.fmin.reduce(one, axis=0) for one in values])
    seen = problem.given.visible.sum(axis=0)
    enough = seen >= np.clip(len(problem.given.times) - seen, 2, _ENOUGH)
    return np.where(enough & (highest == lowest), highest, np.nan)
