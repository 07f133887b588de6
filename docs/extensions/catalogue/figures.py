"""Figures of the report on a page of the site, and the style sheet that they need."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib.resources import files

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.figures.scores.ranking import ranking
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["ranking_figure", "style_sheet"]

FIGURE = ".report-figure"
DARK = "html[data-theme=dark]"
LAYOUT = f"""\
{FIGURE} {{ margin: 1rem 0; }}
{FIGURE} .plot {{ background: none; }}
{FIGURE} .plot {{ width: min(100%, 36rem); font-family: system-ui, sans-serif; }}
{FIGURE} .plot text.name {{ font-size: 10px; }}
{FIGURE} g[class] {{ margin: 0; font: inherit; }}
{FIGURE} figcaption {{ color: var(--pst-color-text-muted); font-size: .9rem; text-align: left; }}
table.catalogue {{ width: auto; }}
table.catalogue p {{ margin: 0; }}
table.catalogue :is(th, td) {{ padding: .25rem .5rem; vertical-align: top; }}
table.numbers tr > :nth-child(n + 3), table.published tr > :nth-child(2) {{ text-align: right; }}
@media (min-width: 40rem) {{
  :is(table.numbers, table.places) :is(th, td) {{ white-space: nowrap; }}
  table.published th {{ white-space: normal; }}
}}
"""
"""What pages add to the styles of the report."""


def ranking_figure(results: TaskResults, styles: Mapping[str, DrawingStyle]) -> SvgFigure | None:
    """Return the ranking by the first metric of a task; None where nothing competes."""
    return ranking(results, results.layout.page.metrics[0], styles)


def style_sheet() -> str:
    """Return the report's styles of figures, for those on pages and for the site's own themes."""
    light, dark = re.findall(r":root \{(.*?)\}", _style("colours"), re.DOTALL)
    return "\n".join(
        [
            f"{FIGURE} {{{light}}}",
            f"{DARK} {FIGURE} {{{dark}}}",
            f"{FIGURE} {{\n{_style('figures')}}}",
            LAYOUT,
        ]
    )


def _style(name: str) -> str:
    path = files("mocapbench.reports.page") / "styles" / f"{name}.css"
    return path.read_text(encoding="utf-8")
