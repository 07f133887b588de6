"""The critical-difference diagram: mean ranks, and groups of entrants that are not separable.

One row per entrant, best on top, so that names never collide and the diagram fits a phone. A
vertical bar on the right joins a group that is not separable. The caption names the groups too, for
readers who do not see the bars.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.metrics.statistics import friedman, group_ranks, mean_ranks, nemenyi
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis, panels
from mocapbench.reports.figures.marks import dot, horizontal, svg, text, vertical
from mocapbench.reports.figures.scale import LinearScale
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["rank_figure", "rank_labels"]

BAR_GAP = 7.0
"""Between the bars of two groups, in pixels."""


def rank_figure(losses: pd.DataFrame, title: str, styles: Mapping[str, DrawingStyle]) -> SvgFigure:
    """Return the diagram of the ranks of columns.

    Parameters
    ----------
    losses : DataFrame
        As `mocapbench.reports.analysis.ranks.ranks_over_units` returns them.
    title : str
    styles : mapping of str to DrawingStyle
        How each label is drawn.
    """
    whole = losses.dropna(axis=1)
    left_out = [str(label) for label in losses.columns.difference(whole.columns, sort=False)]
    means, groups = rank_labels(whole)
    over = f"over {format_count(len(whole), str(losses.index.name))}"
    label = f"{title}: mean ranks of {format_count(len(means), 'entrant')} {over}"
    marks = [text(0.0, 13.0, f"ranks {over}", "title"), *_marks(means, groups, styles)]
    drawing = svg(WIDTH, TOP + ROW * len(means) + BOTTOM, label, marks)
    test = friedman(whole), nemenyi(*whole.shape)
    caption = f"mean ranks {over}. {_caption(*test, groups)}"
    lacking = f" Left out, without every score: {', '.join(left_out)}." if left_out else ""
    return SvgFigure(title, panels([drawing]), (), caption + lacking)


def rank_labels(losses: pd.DataFrame) -> tuple[pd.Series[float], list[list[str]]]:
    """Return the mean ranks of columns, the best first, and groups that are not separable.

    Parameters
    ----------
    losses : DataFrame
        A row for each unit and a column for each label, without NaN.
    """
    ranks = mean_ranks(losses)
    means = pd.Series(ranks, losses.columns).sort_values(kind="stable")
    groups = group_ranks(ranks, nemenyi(*losses.shape), friedman(losses))
    return means, [[str(losses.columns[entrant]) for entrant in group] for group in groups]


def _marks(
    means: pd.Series[float], groups: Sequence[Sequence[str]], styles: Mapping[str, DrawingStyle]
) -> list[str]:
    """Return the axis, a row for each entrant and a bar for each group that is not separable."""
    stop = WIDTH - 34.0 - BAR_GAP * len(groups)
    scale = LinearScale(0.8, len(means), NAMES, stop)
    places = {label: place_of(number) for number, label in enumerate(means.index)}
    return [
        bottom_axis(scale, TOP + ROW * len(means), "mean rank (1 is best)"),
        *(_row(styles[str(n)], at, mean, scale) for at, (n, mean) in enumerate(means.items())),
        *(
            vertical(
                [WIDTH - 3.0 - BAR_GAP * number],
                places[group[0]] - 5.0,
                places[group[-1]] + 5.0,
                kind="bar",
            )
            for number, group in enumerate(reversed(groups))
        ),
    ]


def _row(style: DrawingStyle, number: int, mean: float, scale: LinearScale) -> str:
    x, y = scale.place(mean), place_of(number)
    marks = (
        horizontal(scale.start, x, y, "grid"),
        dot(x, y, style.shape),
        text(x + 8.0, y + 4.0, f"{mean:.1f}"),
    )
    return row(style, number, *marks, title=f"{style.label}: mean rank {mean:.2f}")


def _caption(p_value: float, difference: float, groups: Sequence[Sequence[str]]) -> str:
    named = "; ".join(map(", ".join, groups))
    together = f"Not separable, joined by a bar: {named}." if groups else "All are separable."
    return (
        f"Friedman’s test of no difference: p = {p_value:.2g}; "
        f"Nemenyi’s critical difference at 5 %: {difference:.2f} ranks. {together}"
    )
