"""The critical-difference diagram: mean ranks, and groups of entrants that are not separable.

One row per entrant, best on top, so that names never collide and the diagram fits a phone. A
vertical bar on the right joins a group that is not separable. The caption names the groups too, for
readers who do not see the bars.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.ranks import Ranks
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis, panels
from mocapbench.reports.figures.marks import dot, horizontal, svg, text, vertical
from mocapbench.reports.figures.scale import LinearScale
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["rank_figure"]

BAR_GAP = 7.0
"""Between the bars of two groups, in pixels."""


def rank_figure(ranks: Ranks, title: str, styles: Mapping[str, DrawingStyle]) -> SvgFigure:
    """Return the diagram of ``ranks``."""
    return SvgFigure(title, panels([_diagram(ranks, title, styles)]), (), _caption(ranks))


def _diagram(ranks: Ranks, title: str, styles: Mapping[str, DrawingStyle]) -> Markup:
    means, n_entrants = ranks.comparison.mean_ranks, len(ranks.labels)
    order = sorted(range(n_entrants), key=means.__getitem__)
    stop = WIDTH - 34.0 - BAR_GAP * len(ranks.comparison.groups)
    scale, bottom = LinearScale(0.8, n_entrants, NAMES, stop), TOP + ROW * n_entrants
    n = format_count(ranks.comparison.n, ranks.unit)
    marks = [
        text(0.0, 13.0, f"ranks over {n}", "title"),
        bottom_axis(scale, bottom, "mean rank (1 is best)"),
        *(
            _row(styles[ranks.labels[entrant]], number, means[entrant], scale)
            for number, entrant in enumerate(order)
        ),
        *_bars(ranks, {entrant: number for number, entrant in enumerate(order)}),
    ]
    label = f"{title}: mean ranks of {format_count(n_entrants, 'entrant')} over {n}"
    return svg(WIDTH, bottom + BOTTOM, label, marks)


def _row(style: DrawingStyle, number: int, mean: float, scale: LinearScale) -> str:
    x, y = scale.place(mean), place_of(number)
    marks = (
        horizontal(scale.start, x, y, "grid"),
        dot(x, y, style.shape),
        text(x + 8.0, y + 4.0, f"{mean:.1f}"),
    )
    return row(style, number, *marks, title=f"{style.label}: mean rank {mean:.2f}")


def _bars(ranks: Ranks, rows: Mapping[int, int]) -> Iterator[str]:
    """Yield a bar for each group that is not separable; ``rows`` are by entrant."""
    for place, group in enumerate(reversed(ranks.comparison.groups)):
        ends = place_of(rows[group[0]]) - 5.0, place_of(rows[group[-1]]) + 5.0
        yield vertical([WIDTH - 3.0 - BAR_GAP * place], *ends, kind="bar")


def _caption(ranks: Ranks) -> str:
    comparison = ranks.comparison
    n = format_count(comparison.n, ranks.unit)
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
