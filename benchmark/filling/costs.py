"""What it costs a model to fill a problem, predicted from the sizes of the problem alone.

Costs are counted in seconds of a reference machine: one core of a server, on which every model was
measured once (``docs/evidence/fill_costs.py``). Nothing here looks at a clock: a prediction is the
same on every machine, idle or busy.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mocapbench.basics.arrays import Index
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gap_problem import GapProblem, drop_unseen, place_windows
from mocapbench.benchmark.filling.gaps import find_gaps
from mocapbench.benchmark.registry import UNCALIBRATED, build_unfitted, find_calibration

__all__ = [
    "STAND_IN",
    "START",
    "TABLE",
    "Sizes",
    "count_seconds",
    "load_measured_costs",
    "measure_sizes",
    "predict_calibrated_seconds",
    "predict_seconds",
]

START = 0.02
"""Seconds that an attempt takes at least, to start a process and hand over the problem."""
STAND_IN = "lds"
"""The model whose costs others are given that were not measured and declare none."""
CALIBRATING = 5.0
"""By how much calibration makes a model dearer that was not measured."""
TABLE = Path(__file__).with_name("costs.csv")
"""Of each model and method the coefficient ``seconds``, and the exponents of `Sizes`."""


class Sizes(NamedTuple):
    """The sizes of a problem on which costs depend.

    Parameters
    ----------
    windows : float
        How many windows the model fills one by one.
    frames : float
        Of a window; those of training recordings are counted too.
    channels : float
        That are visible somewhere, or wanted.
    gaps : float
        The mean number in a window; channels hidden over the same frames have one together.
    longest : float
        Frames of the longest gap.
    widest : float
        The most channels that are hidden in a frame.
    """

    windows: float
    frames: float
    channels: float
    gaps: float
    longest: float
    widest: float


def predict_seconds(name: str, problem: GapProblem) -> float:
    """Return what it costs a model to fit to a problem and fill it, without calibration.

    Parameters
    ----------
    name : str
        A model that was measured has its own costs, one of a plug-in those that it declares
        (`mocapbench.baselines.FrameImputer.fill_cost`), or else those of `STAND_IN`.
    problem : GapProblem

    Returns
    -------
    float
        In seconds of the reference machine; infinite if a gap is too long for the model's windows.
        It depends on the `Sizes` of the problem alone, and grows with each of them.

    Raises
    ------
    UsageError
        If the model declares costs that are none.
    """
    return _predict(name, problem, "impute_uncalibrated")


def predict_calibrated_seconds(name: str, problem: GapProblem) -> float:
    """Return what it costs a model to do so with calibrated variances; see `predict_seconds`."""
    return max(_predict(name, problem, "impute"), predict_seconds(name, problem))


def _predict(name: str, problem: GapProblem, method: str) -> float:
    model: Any = build_unfitted(name)
    try:
        sizes = measure_sizes(problem, model.max_frames)
    except ValueError:  # a gap is longer than any window
        return math.inf
    return count_seconds(_find_cost(name, model, method), sizes)


def _find_cost(name: str, model: Any, method: str) -> Mapping[str, float]:
    """Return the coefficient and the exponents of a model, called as in the table."""
    measured, listed = load_measured_costs(), name.removesuffix(UNCALIBRATED)
    is_calibrated = method == "impute" and find_calibration(name) is not None
    key = "impute" if is_calibrated else "impute_uncalibrated"  # which are the same for the others
    declared: Mapping[str, float] | None = getattr(model, "fill_cost", None)
    if (listed, key) in measured or declared is None:
        return measured.get((listed, key), measured[STAND_IN, key])
    _check_declared(name, declared)
    return {**declared, "seconds": declared["seconds"] * (CALIBRATING if is_calibrated else 1.0)}


def _check_declared(name: str, declared: Any) -> None:
    """Refuse costs that a model declares in another form than that of a row of the table."""
    sizes = Sizes._fields[1:]
    try:
        numbers = [float(declared["seconds"]), *(float(each) for each in declared.values())]
        good = {*declared} <= {"seconds", *sizes} and all(
            0.0 <= each < math.inf for each in numbers
        )
    except (TypeError, KeyError, ValueError, AttributeError):
        good = False
    if not good:
        raise UsageError(
            f"model {name!r}: expected a fill_cost that maps 'seconds', and some of "
            f"{', '.join(map(repr, sizes))}, to numbers of at least 0, got {declared!r}; correct "
            "it, or leave it out"
        )


def count_seconds(cost: Mapping[str, float], sizes: Sizes) -> float:
    """Return the seconds of an attempt: a power law of the sizes of a window, times their number.

    Parameters
    ----------
    cost : mapping of str to float
        The coefficient ``"seconds"``, and exponents by the names of sizes.
    sizes : Sizes
    """
    powers = [float(size) ** cost.get(name, 0.0) for name, size in sizes._asdict().items()]
    work = sizes.windows * cost["seconds"] * math.prod(powers)
    return START + float(work)


def measure_sizes(problem: GapProblem, max_frames: int | None) -> Sizes:
    """Return the sizes of a problem for a model that takes at most so many frames.

    Raises
    ------
    ValueError
        If a gap is too long for any window.
    """
    n_channels, gaps, widest = _find_hidden(problem)
    windows = [frames for frames, _ in place_windows(problem, max_frames)]
    n_frames = min(problem.n_frames, max_frames or problem.n_frames)
    starts, stops = gaps.T
    in_windows = [np.sum((starts < each.stop) & (stops > each.start)) for each in windows]
    return Sizes(
        windows=len(windows),
        frames=n_frames,
        channels=n_channels,
        gaps=max(float(np.mean(in_windows)), 1.0),
        longest=min(max((stops - starts).tolist(), default=1), n_frames),
        widest=widest,
    )


@lru_cache(maxsize=1)  # of the problem of which models are asked one after another
def _find_hidden(problem: GapProblem) -> tuple[int, Index, int]:
    """Return how many channels count, the bounds of all gaps (K, 2), and the size ``widest``."""
    hidden = ~drop_unseen(problem).given.visible
    bounds = [(gap.start, gap.stop) for gap in find_gaps(hidden)]
    return hidden.shape[1], np.reshape(bounds, (-1, 2)), max(int(hidden.sum(axis=1).max()), 1)


@cache
def load_measured_costs() -> Mapping[tuple[str, str], Mapping[str, float]]:
    """Return the table by model and method."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return {
            (row.pop("model"), row.pop("method")): {name: float(row[name]) for name in row}
            for row in csv.DictReader(file)
        }
