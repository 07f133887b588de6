"""The critical-difference diagram: mean ranks, and groups of entrants that are not separable.

One row per entrant, best on top, so that names never collide and the diagram fits a phone. A
vertical bar on the right joins a group that is not separable. The caption names the groups too, for
readers who do not see the bars.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure

from mocapbench.reports.analysis.ranks import Ranks
from mocapbench.reports.figures.line_styles import SMALLEST_SCALE
from mocapbench.reports.figures.svg import INK, PALETTE, RULE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["rank_figure"]

WIDTH, ROW_HEIGHT, FRAME_HEIGHT = 5.2, 0.24, 0.85
GROUP_GAP = 0.18
LABEL_SHARE = 0.14  # share of the axis that the number beside the last dot needs


def rank_figure(ranks: Ranks, title: str, name: str) -> SvgFigure:
    """Return the diagram of ``ranks``; the ids of its parts start with ``name``."""
    with rc_context(STYLE):
        return SvgFigure(title, _diagram(ranks, title, slug(name, "ranks")), (), _caption(ranks))


def _diagram(ranks: Ranks, title: str, prefix: str) -> Markup:
    mean_ranks, n_entrants = ranks.comparison.mean_ranks, len(ranks.labels)
    order = sorted(range(n_entrants), key=mean_ranks.__getitem__)
    figure = Figure(figsize=(WIDTH, FRAME_HEIGHT + ROW_HEIGHT * n_entrants), layout="constrained")
    axes = figure.subplots()
    _draw_means(axes, [mean_ranks[entrant] for entrant in order])
    _draw_groups(axes, ranks, {entrant: row for row, entrant in enumerate(order)})
    _label_axes(axes, [ranks.labels[entrant] for entrant in order])
    n = counted(ranks.comparison.n, ranks.unit)
    return svg_element(
        figure,
        prefix,
        role="img",
        aria_label=f"{title}: mean ranks of {counted(n_entrants, 'entrant')} over {n}",
        style=f"min-width: {SMALLEST_SCALE * WIDTH:.2f}in",
    )


def _draw_means(axes: Axes, means: Sequence[float]) -> None:
    rows = range(len(means))
    axes.hlines(rows, 1.0, means, color=RULE, linewidth=1.0, zorder=1)
    axes.plot(means, rows, "o", color=PALETTE[0], markersize=6.0, zorder=2)
    for mean, row in zip(means, rows, strict=True):
        axes.annotate(f"{mean:.1f}", (mean, row), (6, 0), textcoords="offset points", va="center")


def _draw_groups(axes: Axes, ranks: Ranks, rows: Mapping[int, int]) -> None:
    """Join each group that is not separable by a bar; ``rows`` are by entrant."""
    for place, group in enumerate(ranks.comparison.groups, start=1):
        ends = [rows[group[0]] - 0.25, rows[group[-1]] + 0.25]
        across = len(rows) * (1.0 + LABEL_SHARE + GROUP_GAP * place / 4)
        axes.plot([across] * 2, ends, color=INK, linewidth=3.0, solid_capstyle="butt")


def _label_axes(axes: Axes, labels: Sequence[str]) -> None:
    last = len(labels)
    axes.set_yticks(range(last), labels)
    axes.set_xticks(range(1, last + 1))
    axes.set(xlabel="mean rank (1 is best)", xlim=(0.7, None), ylim=(last - 0.4, -0.6))
    axes.tick_params(axis="y", length=0)
    axes.spines["bottom"].set_bounds(1, last)


def _caption(ranks: Ranks) -> str:
    comparison, unit = ranks.comparison, ranks.unit
    n = counted(comparison.n, unit)
    groups = "; ".join(", ".join(ranks.labels[entrant] for entrant in g) for g in comparison.groups)
    together = f"Not separable, joined by a bar: {groups}." if groups else "All are separable."
    left_out = ", ".join(ranks.left_out)
    return " ".join(
        [
            f"mean ranks over {n}. Friedman’s test of no difference: p = {comparison.p_value:.2g};",
            f"Nemenyi’s critical difference at 5 %: {comparison.difference:.2f} ranks. {together}",
            *([f"Left out, without every score: {left_out}."] if left_out else []),
        ]
    )
