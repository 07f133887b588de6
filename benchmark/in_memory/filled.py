"""A filled recording in a notebook: values, intervals, tables and pictures."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from html import escape
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import ndtri

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_table import tabulate_gaps
from mocapbench.benchmark.filling.messages import describe_choice, describe_fill, list_remarks
from mocapbench.benchmark.in_memory.arguments import name_arguments
from mocapbench.benchmark.in_memory.movement import to_movement
from mocapbench.benchmark.in_memory.pictures import draw_channels
from mocapbench.benchmark.in_memory.saving import save_like
from mocapbench.benchmark.in_memory.tables import tabulate_values
from mocapbench.datasets import FrameByChannel, Mask, Recording

__all__ = ["Filled"]

_SHOWN = 20
"""Gaps that a notebook shows at most."""
_RANKING = ("kind", "model", "error", "unit", "chosen", "may_be_chance", "n_gaps")


class Filled:
    """A recording whose gaps are filled, and how sure each filled value is.

    Parameters
    ----------
    given : Recording
        What was filled.
    result : FilledRecording
        What the engine says of it.
    """

    def __init__(self, given: Recording, result: FilledRecording) -> None:
        self.given: Recording = given
        self.result: FilledRecording = result

    @cached_property
    def recording(self) -> Recording:
        """The recording with its gaps filled; what was not to be filled stays hidden."""
        return self.result.recording

    @property
    def mask(self) -> Mask:
        """(N, D) True where an entry was filled."""
        return self.result.request.target

    @property
    def std(self) -> FrameByChannel:
        """(N, D) standard deviations: 0 where an entry was visible, NaN where there is none."""
        deviations = np.where(self.recording.visible, 0.0, np.nan)
        deviations[self.mask] = self.result.std
        return deviations

    def interval(self, level: float = 0.95) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the lower and the upper bounds (N, D) of the predictive intervals.

        Parameters
        ----------
        level : float, default=0.95
            How likely an interval is to hold the value, between 0 and 1.

        Returns
        -------
        low, high : ndarray of shape (N, D)
            The value itself where an entry was visible, NaN where the model has no intervals.
        """
        given: object = level
        if not isinstance(given, Real) or not 0.0 < float(given) < 1.0:
            raise ValueError(f"expected a level between 0 and 1, such as 0.95, got {level!r}")
        half: Array = ndtri(0.5 + level / 2) * self.std
        return self.recording.values - half, self.recording.values + half

    @cached_property
    def gaps(self) -> pd.DataFrame:
        """A row for each gap of a marker or joint: where it is, what filled it, how well.

        What ``leave`` has leaves the gap open, as the argument of that name.
        """
        return tabulate_gaps(self.result)

    @property
    def ranking(self) -> pd.DataFrame:
        """A row for each kind of gap and model that was compared, the best first.

        The ``error`` is the mean over held-out gaps of the root mean squared error, in ``unit``.
        Where a model ``may_be_chance``, no test tells it from the first. Empty if models were
        named.
        """
        return pd.DataFrame(self._rank_models(), columns=_RANKING)

    def _rank_models(self) -> Iterator[tuple[Any, ...]]:
        result = self.result
        rankings = result.choice.rankings if result.choice else {}
        for kind, ranking in rankings.items():
            number = result.all_kinds.index(kind) if kind in result.all_kinds else -1
            chosen = {*result.models[result.kinds == number].tolist()}
            for model in ranking.order:
                error, may_be = ranking.means[model], model in ranking.rivals
                yield str(kind), model, error, kind.unit, model in chosen, may_be, ranking.n_gaps

    @property
    def messages(self) -> tuple[str, ...]:
        """What was done, which models were compared, what stays open, and what is doubtful."""
        texts = (describe_fill(self.result), *describe_choice(self.result))
        own = getattr(self.given, "remarks", ())
        return tuple(map(name_arguments, (*texts, *list_remarks(self.result), *own)))

    def plot(self, name: str, truth: Recording | None = None, level: float = 0.95) -> Any:
        """Draw the channels of a marker or joint: what was there, what was filled, the interval.

        Parameters
        ----------
        name : str
            A marker or joint, a channel, or a pattern such as ``"L*"``.
        truth : Recording, optional
            What the values really are, of the same frames and channels.
        level : float, default=0.95
            Of the interval.

        Returns
        -------
        ndarray of matplotlib.axes.Axes
            One for each channel.
        """
        bounds, label = self.interval(level), f"{level:.0%} interval"
        return draw_channels(self.recording, self.mask, bounds, name=name, truth=truth, label=label)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row a frame, indexed by time in seconds, and a column a channel."""
        return tabulate_values(self.recording)

    def to_xarray(self) -> Any:
        """Return a dataset of the layout of the package movement, with the variable ``std``."""
        return to_movement(self.recording, self.std)

    def save(self, path: str | Path) -> Path:
        """Write the filled recording to a new file, and return its path.

        That of a file is written as a copy of it, in which all else is as it was; that of an object
        as a table (.csv).

        Parameters
        ----------
        path : path
            Nothing is overwritten.
        """
        return save_like(self.given, self.recording, self.mask, Path(path))

    def __repr__(self) -> str:
        return f"<Filled {self.given.name}: {self.messages[0]}>"

    def _repr_html_(self) -> str:
        """Return what Jupyter shows."""
        first, *others = map(escape, self.messages)
        listed = "".join(f"<li>{text}</li>" for text in others)
        table = self.gaps.to_html(index=False, max_rows=_SHOWN, float_format="{:.4g}".format)
        return f"<p><b>{escape(self.given.name)}</b>: {first}</p><ul>{listed}</ul>{table}"
