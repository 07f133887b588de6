"""Stick figures of a motion: the truth, and what the best models put in its place."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.pictures import Motions
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.look import Styles, colour_of, wrap_text
from mocapbench.reports.figures.styles import TRUTH

__all__ = ["StickFigures"]

N_FIGURES, N_MODELS = 7, 3
STRIDE = 70.0
"""Centimetres from one stick figure to the next, in which the body stays on one spot."""
_COLUMNS = (
    *("task", "panel", "who", "seconds", "hidden"),
    *("joint", "parent", "x", "y"),
)


class StickFigures(Plot):
    """A panel for each of the best models: the truth in ink, the model in its colour over it."""

    narrowest: ClassVar[float] = 36.0
    shows_pictures: ClassVar[bool] = True

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each joint of each figure, with where it is drawn."""
        del metrics
        task = results.layout.name
        found = [p for p in bundle.illustrations if isinstance(p, Motions) and p.task == task]
        tables = [_tabulate_motions(motions, results) for motions in found]
        if not tables or tables[0].empty:
            raise NothingToDrawError(
                "the run keeps no motion of a body, or its recording is not here"
            )
        return {"": tables[0]}

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw bones as lines, the floor and the times."""
        for who, of_one in panel.groupby("who", sort=False):
            style = styles.get(str(who), TRUTH)
            width = 1.0 if style is TRUTH else 1.4
            lines = LineCollection(_list_bones(of_one), colors=colour_of(style), linewidths=width)
            lines.set_capstyle("round")
            axes.add_collection(lines)
        axes.axhline(0.0, color="#d5dae0", linewidth=0.8, zorder=0)
        axes.set_aspect("equal")
        axes.autoscale_view()
        roots = panel[panel["parent"] == ""].drop_duplicates("seconds")
        axes.set_xticks(roots["x"], [f"{time:.2g} s" for time in roots["seconds"]])
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
        axes.set_yticks([])
        axes.set_title(wrap_text(panel["panel"].iloc[0]))

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return the height of the figures on equal scales."""
        ends = panel[["x", "y"]].agg(["min", "max"]).to_numpy()
        span = np.maximum(ends[1] - ends[0], 1.0)
        return float(width * span[1] / span[0]) + 5.0

    def describe(self, table: pd.DataFrame) -> str:
        """Return what is drawn over what."""
        del table
        return (
            "Seen from the side and set apart, at even times from before the hidden frames to "
            "after them. Dark: the recording; coloured: the model."
        )


def _tabulate_motions(motions: Motions, results: TaskResults) -> pd.DataFrame:
    labels = [label for label in motions.motions if label in results.layout.labels][:N_MODELS]
    parts = [
        row
        for label in labels
        for who, places in (
            (motions.truth_of(label), motions.truths.get(motions.truth_of(label))),
            (label, motions.motions[label]),
        )
        if places is not None
        for row in _list_joints(motions, label, who, places)
    ]
    return pd.DataFrame(parts, columns=list(_COLUMNS))


def _list_joints(
    motions: Motions, label: str, who: str, places: Array
) -> Iterator[tuple[object, ...]]:
    """Yield the rows of each joint; bodies are set apart by where the truth's root is."""
    truth = motions.truths.get(motions.truth_of(label), places)
    names = np.array([*motions.joints, ""])
    for number, frame in enumerate(_choose_frames(motions.hidden)):
        at = places[frame, :, 0] - truth[frame, 0, 0] + STRIDE * number
        about = (motions.task, label, who, frame * motions.interval, bool(motions.hidden[frame]))
        for joint, parent in enumerate(motions.parents):
            x, y = float(at[joint]), float(places[frame, joint, 1])
            yield (*about, names[joint], names[parent], x, y)


def _choose_frames(hidden: NDArray[np.bool_]) -> list[int]:
    """Return frames at even times, from before the first hidden one to after the last."""
    found = np.flatnonzero(hidden)
    first, last = (found[0] - 1, found[-1] + 1) if len(found) else (0, len(hidden) - 1)
    ends = max(int(first), 0), min(int(last), len(hidden) - 1)
    return [*dict.fromkeys(np.linspace(*ends, N_FIGURES).round().astype(int).tolist())]


def _list_bones(of_one: pd.DataFrame) -> list[Array]:
    """Return the ends (2, 2) of each bone of each figure."""
    bones = []
    for _, figure in of_one.groupby("seconds", sort=False):
        places = dict(zip(figure["joint"], figure[["x", "y"]].to_numpy(), strict=True))
        pairs = zip(figure["joint"], figure["parent"], strict=True)
        bones += [np.array([places[joint], places[parent]]) for joint, parent in pairs if parent]
    return bones
