"""The longest gap of the channels that lack most, filled by the best models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.datasets import FrameByChannel, Mask, Recording
from mocapbench.reports import Axes, Curve, Illustration

__all__ = ["draw_longest_gaps"]

_MOST_FRAMES = 600
"""More of a gap cannot be told apart in a panel."""


def draw_longest_gaps(
    solved: Solved[ImputeProblem, Predictions], /, n_channels: int = 3, n_best: int = 3
) -> Sequence[Illustration]:
    """Return the longest gap of some channels, and as much of the recording before and after it.

    One picture of the first recording, with a panel per channel.

    Parameters
    ----------
    solved : Solved
    n_channels : int
        How many channels to show: those with most hidden entries.
    n_best : int
        How many entrants to show: those with the least squared error.
    """
    recording, truth = solved.problem.given[0], solved.problem.truth[0]
    hidden = ~recording.visible & np.isfinite(truth)
    means = {label: solution[0].mean for label, solution in solved.solutions.items()}
    errors = {label: float(((m - truth)[hidden] ** 2).mean()) for label, m in means.items()}
    best = sorted(errors, key=errors.__getitem__)[:n_best]
    shown = {"truth": truth, **{b: np.where(hidden, means[b], np.nan) for b in best}}
    most = np.argsort(-hidden.sum(axis=0), kind="stable")[:n_channels]
    panels = tuple(
        _panel(recording, int(column), hidden, shown) for column in most if hidden[:, column].any()
    )
    caption = (
        f"{recording.name}: the longest gap of the channels that lack most, with the truth and "
        f"what the {len(best)} entrants with the least squared error put there."
    )
    return (Illustration(solved.task, "Longest gaps", caption, panels),)


def _panel(
    recording: Recording, column: int, hidden: Mask, shown: Mapping[str, FrameByChannel]
) -> Axes:
    rows = _around(_longest_run(hidden[:, column]), len(hidden))
    curves = tuple(
        Curve(recording.times[rows], values[rows, column], label) for label, values in shown.items()
    )
    return Axes(recording.channels[column], "time, s", recording.units[column], curves)


def _longest_run(hidden: NDArray[np.bool_]) -> tuple[int, int]:
    """Return where the longest run of True (N,) begins, and where it has ended."""
    bounds = run_bounds(hidden)
    start, stop = bounds[np.argmax(np.diff(bounds, axis=1))].tolist()
    return start, stop


def _around(run: tuple[int, int], n_frames: int) -> slice:
    """Return the frames of a run and as many on either side, not too many in all."""
    start, stop = run
    length = min(stop - start, _MOST_FRAMES)
    margin = max(length, 10)
    return slice(max(start - margin, 0), min(start + length + margin, n_frames))
