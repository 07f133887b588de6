"""Pictures of filled channels, by matplotlib."""

from __future__ import annotations

from typing import Any

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.filling.requests.names import match_pattern, name_owners
from mocapbench.benchmark.in_memory.extras import require_extra
from mocapbench.datasets import FrameByChannel, Mask, Recording

__all__ = ["draw_channels"]

_WIDTH, _HEIGHT = 7.0, 1.9
_BESIDE = 1.0
"""Of the time from the first filled entry to the last, what is shown on each side."""
_BLUE, _GREY = "#1f6fb2", "#555555"


def draw_channels(
    recording: Recording,
    mask: Mask,
    bounds: tuple[FrameByChannel, FrameByChannel],
    *,
    name: str,
    truth: Recording | None,
    label: str,
) -> Any:
    """Return axes (n,) with the channels that a name stands for.

    Parameters
    ----------
    recording : Recording
        Filled.
    mask : ndarray of bool of shape (N, D)
        What was filled.
    bounds : tuple of ndarray of shape (N, D)
        Of the intervals.
    name : str
        A marker or joint, a channel, or a pattern of such names.
    truth : Recording or None
    label : str
        What the intervals are called.
    """
    pyplot = require_extra("matplotlib.pyplot", "plot")
    columns = _find_columns(recording, name)
    _, grid = pyplot.subplots(
        len(columns),
        sharex=True,
        squeeze=False,
        figsize=(_WIDTH, _HEIGHT * len(columns)),
        layout="constrained",
    )
    axes = grid[:, 0]
    for one, column in zip(axes, columns, strict=True):
        shown = _join_neighbours(mask[:, column])
        low, high = (np.where(shown, bound[:, column], np.nan) for bound in bounds)
        one.fill_between(recording.times, low, high, color=_BLUE, alpha=0.25, lw=0, label=label)
        _draw_values(one, recording, mask[:, column], column)
        if truth is not None:
            values = truth.select([recording.channels[column]]).values
            one.plot(truth.times, values, "--", color="black", lw=1, label="truth")
    _show_gaps(axes[-1], recording.times, np.asarray(mask[:, columns].any(axis=1)))
    axes[0].legend(loc="upper right")
    return axes


def _find_columns(recording: Recording, name: str) -> list[int]:
    """Return the columns of channels that match a pattern, themselves or by what they belong to."""
    columns: list[int] = np.flatnonzero(match_pattern(recording.channels, name)).tolist()
    if not columns:
        known = [*dict.fromkeys((*name_owners(recording.channels), *recording.channels))]
        raise UnknownNameError("marker, joint or channel", name, known)
    return columns


def _draw_values(axes: Any, recording: Recording, filled: Mask, column: int) -> None:
    """Draw what was visible and what was filled of a channel."""
    times, values = recording.times, recording.values[:, column]
    shown = np.where(_join_neighbours(filled), values, np.nan)
    axes.plot(times, shown, color=_BLUE, label="filled")
    axes.plot(times, np.where(filled, np.nan, values), color=_GREY, label="visible")
    channel, unit = recording.channels[column], recording.units[column]
    axes.set_ylabel(f"{channel} ({unit})" if unit else channel)


def _join_neighbours(filled: Mask) -> Mask:
    """Return the filled entries and those beside them, so that lines join."""
    shown = filled.copy()
    shown[:-1] |= filled[1:]
    shown[1:] |= filled[:-1]
    return shown


def _show_gaps(axes: Any, times: Array, filled: Mask) -> None:
    """Show the time around what was filled."""
    axes.set_xlabel("time (s)")
    runs = run_bounds(filled)
    if len(runs):
        first, last = times[runs[0, 0]], times[runs[-1, 1] - 1]
        beside = _BESIDE * max(last - first, (times[-1] - times[0]) / len(times) * 10)
        axes.set_xlim(max(times[0], first - beside), min(times[-1], last + beside))
