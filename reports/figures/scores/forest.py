"""Published values beside ours: a row each, table by table of the papers."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.comparisons import Comparison, PublishedVerdict
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis, panels
from mocapbench.reports.figures.marks import dot, horizontal, svg, text, vertical
from mocapbench.reports.figures.scale import LogScale, Scale, fit_scale
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure, key

__all__ = ["forest"]

MARKS = {
    PublishedVerdict.WITHIN_2_PERCENT: "=",
    PublishedVerdict.WITHIN_PAPER_SD: "≈",
    PublishedVerdict.BETTER: "▲",
    PublishedVerdict.WORSE: "▼",
    PublishedVerdict.UNDECIDED: "?",
    PublishedVerdict.NOT_COMPARABLE: "≠",
}
DIAMOND = 3
STOP = WIDTH - 22.0
_PAPER = DrawingStyle("hr", DIAMOND)
CAPTION = (
    "grey diamonds are the papers’ values, with their ± where printed; ours are in the colour of "
    "the model, with 95 % intervals where folds give one. = within 2 %, ≈ within the "
    "paper’s ±, ▲ better, ▼ worse, ? undecided, ≠ not comparable."
)


def forest(
    results: TaskResults, pairs: Sequence[Comparison], styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return a panel for each table of a paper and metric; None without a published value."""
    tables = defaultdict(list)
    for pair in pairs:
        tables[pair.published.source, pair.published.metric].append(pair)
    if not tables:
        return None
    drawn = [_panel(f"{source}, {metric}", of, styles) for (source, metric), of in tables.items()]
    legend = (key("published", _PAPER, dot(14.0, 7.0, DIAMOND)),)
    title = f"Published values beside ours: {results.layout.page.title}"
    return SvgFigure(title, panels(drawn), legend, CAPTION)


def _panel(title: str, pairs: Sequence[Comparison], styles: Mapping[str, DrawingStyle]) -> Markup:
    scale = fit_scale((end for pair in pairs for end in _values(pair)), NAMES, STOP)
    bottom = TOP + ROW * len(pairs)
    marks = [
        text(0.0, 13.0, title, "title"),
        vertical(map(scale.place, scale.ticks(4)), TOP, bottom, "grid"),
        bottom_axis(scale, bottom, "logarithmic" if isinstance(scale, LogScale) else ""),
        *(_row(pair, number, scale, styles[pair.label]) for number, pair in enumerate(pairs)),
    ]
    name = f"{title}: {format_count(len(pairs), 'published value')} beside ours"
    return svg(WIDTH, bottom + BOTTOM, name, marks)


def _values(pair: Comparison) -> tuple[float, float]:
    return pair.ours.mean, pair.published.value


def _row(pair: Comparison, number: int, scale: Scale, style: DrawingStyle) -> str:
    y, ours, paper = place_of(number), pair.ours.mean, pair.published.value
    theirs = [
        _line(paper, pair.published.two_sd, scale, y - 2.5),
        dot(scale.place(paper), y - 2.5, DIAMOND),
    ]
    marks = [
        f'<g class="{_PAPER.classes}">{"".join(theirs)}</g>',
        _line(ours, pair.ours.half_width, scale, y + 2.5),
        dot(scale.place(ours), y + 2.5, style.shape),
        text(WIDTH - 4.0, y + 4.0, MARKS[pair.verdict], "end"),
    ]
    numbers = f"ours {ours:.4g}, published {paper:.4g}, {pair.verdict.value}"
    summary = f"{pair.label}, {pair.case.heading}: {numbers}"
    return row(style, number, *marks, title=summary, name=f"{pair.label}, {pair.case.name}")


def _line(middle: float, half: float | None, scale: Scale, y: float) -> str:
    """Return an interval, cut where the axis ends."""
    if half is None:
        return ""
    low, high = max(middle - half, scale.low), min(middle + half, scale.high)
    return horizontal(scale.place(low), scale.place(high), y)
