"""Convert a matplotlib figure to an SVG element of the page.

Matplotlib draws with placeholder colours, which become CSS variables. One SVG therefore serves
light and dark pages.
"""

from __future__ import annotations

import re
from io import StringIO
from typing import Any

from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

__all__ = ["INK", "LEVELS", "PALETTE", "RULE", "STYLE", "svg_element"]

N_COLOURS = 9
PALETTE = [f"#fe01{index:02x}" for index in range(N_COLOURS)]
LEVELS = [f"#fe03{index:02x}" for index in range(9)]
"""From the most negative, through zero, to the most positive."""
INK, RULE = "#fe0201", "#fe0202"
VARIABLES = {
    INK: "var(--ink)",
    RULE: "var(--rule)",
    **{colour: f"var(--series-{index})" for index, colour in enumerate(PALETTE)},
    **{colour: f"var(--level-{index})" for index, colour in enumerate(LEVELS)},
}
STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "mocapbench",
    "text.parse_math": False,
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 10,
    "text.color": INK,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "grid.color": RULE,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.facecolor": "none",
    "figure.facecolor": "none",
    "path.simplify": True,
}


def svg_element(figure: Figure, prefix: str, **attributes: str) -> Markup:
    """Return ``figure`` as an SVG element.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    prefix : str
        Start of all its ids, which makes them unique on the page.
    **attributes : str
        Attributes of the element; underscores in their names stand for hyphens.
    """
    svg = _svg(figure)
    text = re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.DOTALL)
    text = re.sub(r"\n\s*", "\n", text)
    text = re.sub(r'\bid="', f'id="{prefix}-', text)
    text = re.sub(r'(?:xlink:)?href="#', f'href="#{prefix}-', text)
    text = text.replace("url(#", f"url(#{prefix}-")
    text = re.sub(r'\b(?:d|x|y|transform)="[^"]*"', _one_decimal, text)
    for colour, variable in VARIABLES.items():
        text = text.replace(colour, variable)
    named = [Markup(' {}="{}"').format(k.replace("_", "-"), v) for k, v in attributes.items()]
    return Markup(text.replace("<svg", Markup("<svg") + Markup("").join(named), 1).strip())


def _svg(figure: Figure) -> str:
    FigureCanvasSVG(figure)
    nothing = dict.fromkeys(("Creator", "Date", "Format", "Type"))
    target = StringIO()
    figure.savefig(target, format="svg", metadata=nothing)
    return target.getvalue()


def _one_decimal(attribute: re.Match[str]) -> str:
    """Cut coordinates to a tenth of a point, which halves the size of the page."""
    return re.sub(r"(\.\d)\d+", r"\1", attribute.group())
