"""What it costs a model to fill a problem, predicted from the sizes of the problem alone.

Costs are counted in seconds of a reference machine: one core of a server, on which every model was
measured once (``docs/evidence/fill_costs.py``). Nothing here looks at a clock: a prediction is the
same on every machine, idle or busy.
"""

from __future__ import annotations

import csv
import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gap_problem import GapProblem, drop_unseen, place_windows
from mocapbench.benchmark.filling.gaps import Gap, find_gaps
from mocapbench.benchmark.registry import UNCALIBRATED, build_unfitted, find_calibration
from mocapbench.datasets import Mask

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
        Their mean number in a window; channels hidden over the same frames have one together.
    longest : float
        Frames of the longest gap.
    groups : float
        Of channels that have all their gaps together; their mean number in a window.
    parts : float
        Gaps of each channel in frames where others are visible; their mean number in a window.
        Where all gaps are of whole frames it is 1.
    """

    windows: float
    frames: float
    channels: float
    gaps: float
    longest: float
    groups: float
    parts: float


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
    cost = {size: float(number) for size, number in declared.items()}
    return {**cost, "seconds": cost["seconds"] * (CALIBRATING if is_calibrated else 1.0)}


def _check_declared(name: str, declared: Any) -> None:
    """Refuse costs that a model declares in another form than that of a row of the table."""
    sizes = Sizes._fields[1:]
    try:
        numbers = [float(declared["seconds"]), *(float(each) for each in declared.values())]
        good = {*declared} <= {"seconds", *sizes} and all(0.0 <= each <= 9.0 for each in numbers)
    except (TypeError, KeyError, ValueError, AttributeError):
        good = False
    if not good:
        raise UsageError(
            f"model {name!r}: expected a fill_cost that maps 'seconds', and some of "
            f"{', '.join(map(repr, sizes))}, to numbers from 0 to 9, got {declared!r}; correct "
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
    powers = (math.pow(size, cost.get(name, 0.0)) for name, size in sizes._asdict().items())
    return START + sizes.windows * cost["seconds"] * math.prod(powers)


def measure_sizes(problem: GapProblem, max_frames: int | None) -> Sizes:
    """Return the sizes of a problem for a model that takes at most so many frames.

    Raises
    ------
    ValueError
        If a gap is too long for any window.
    """
    n_channels, gaps, parts = _find_gaps(problem)
    n_frames = min(problem.n_frames, max_frames or problem.n_frames)
    windows = [frames for frames, _ in place_windows(problem, max_frames)]
    counts = [
        (len(each), _count_groups(each), sum(len(part.channels) for part in parts.within(frames)))
        for frames, each in zip(windows, map(gaps.within, windows), strict=True)
    ]
    n_gaps, n_groups, n_parts = np.maximum(np.mean(counts, axis=0), 1.0).tolist()
    longest = min(gaps.longest, n_frames)
    return Sizes(len(windows), n_frames, n_channels, n_gaps, longest, n_groups, n_parts)


class _Gaps:
    """Gaps that can be looked up by frames."""

    def __init__(self, hidden: Mask) -> None:
        self._gaps = find_gaps(hidden)
        self._starts, self._stops = (
            np.array([getattr(gap, end) for gap in self._gaps], dtype=int)
            for end in ("start", "stop")
        )

    @property
    def longest(self) -> int:
        """Frames of the longest gap, at least 1."""
        return max(map(len, self._gaps), default=1)

    def within(self, frames: slice) -> list[Gap]:
        """Return the gaps that a window has, or a part of them."""
        near = (self._starts < frames.stop) & (self._stops > frames.start)
        return [self._gaps[number] for number in np.flatnonzero(near)]


@lru_cache(maxsize=1)  # of the problem of which models are asked one after another
def _find_gaps(problem: GapProblem) -> tuple[int, _Gaps, _Gaps]:
    """Return how many channels count, all gaps, and those in frames where others are visible."""
    visible = drop_unseen(problem).given.visible
    return visible.shape[1], _Gaps(~visible), _Gaps(~visible & visible.any(axis=1, keepdims=True))


def _count_groups(gaps: Sequence[Gap]) -> int:
    """Return how many groups of channels have all their gaps together."""
    gaps_of: dict[int, list[int]] = defaultdict(list)
    for number, gap in enumerate(gaps):
        for channel in gap.channels:
            gaps_of[channel].append(number)
    return len({tuple(numbers) for numbers in gaps_of.values()})


@cache
def load_measured_costs() -> Mapping[tuple[str, str], Mapping[str, float]]:
    """Return the table by model and method."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return {
            (row.pop("model"), row.pop("method")): {name: float(row[name]) for name in row}
            for row in csv.DictReader(file)
        }
