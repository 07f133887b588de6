"""Slope charts: for each cell a line from its score in A to its score in B."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from markupsafe import Markup, escape

from mocapbench.reports.run_comparison.values import ScoreChange
from mocapbench.reports.text import MINUS, slug

__all__ = ["slope_chart"]

NARROW, WIDE, HEIGHT = 330, 640, 300
LEFT, RIGHT, TOP, BOTTOM = 70, 250, 30, 290
GAP, MOST_NAMED, LONGEST = 14, 18, 22
LOG_SPAN = 10.0


def slope_chart(title: str, names: tuple[str, str], scores: Sequence[ScoreChange]) -> Markup:
    """Return the lines of ``scores`` as SVG, those that differ by more than chance in colour.

    Parameters
    ----------
    title : str
        What the chart is called where it is read aloud.
    names : tuple of two str
        The runs, above the two ends.
    scores : sequence of ScoreChange
        Of one task and metric. The scale is logarithmic where all are positive and span a factor
        of ten.
    """
    values = [value for score in scores for value in (score.first, score.second)]
    height, ends = _height(values), sorted({min(values), max(values)})
    ordered = sorted(scores, key=lambda score: score.verdict.more_than_chance)  # colours on top
    labels = _labels(ordered, height)
    marks = [
        _text(0, 14, _short(names[0]), "start"),
        _text(RIGHT, 14, _short(names[1]), "middle"),
        *(_text(LEFT - 6, height(at) + 4, _digits(at), "end") for at in ends),
        *(_line(score, height) for score in ordered),
        *labels,
    ]
    return Markup(
        '<svg viewBox="0 0 {0} {1}" width="{0}" role="img" aria-label="{2}">{3}</svg>'
    ).format(WIDE if labels else NARROW, HEIGHT, title, Markup().join(marks))


def _short(name: str) -> str:
    return name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"


def _height(values: Sequence[float]) -> Callable[[float], float]:
    """Return the scale from a value to its height on the chart."""
    low, high = min(values), max(values)
    scale = math.log if low > 0.0 and high > LOG_SPAN * low else float
    bottom, span = scale(low), scale(high) - scale(low)
    return lambda value: BOTTOM - (BOTTOM - TOP) * ((scale(value) - bottom) / span if span else 0.5)


def _line(score: ScoreChange, height: Callable[[float], float]) -> Markup:
    return Markup('<path class="{}" d="M{} {:.1f}L{} {:.1f}"><title>{}</title></path>').format(
        slug(score.verdict.value),
        *(LEFT, height(score.first), RIGHT, height(score.second)),
        _describe_change(score),
    )


def _describe_change(score: ScoreChange) -> str:
    return f"{score.label} · {score.case}: {_digits(score.first)} → {_digits(score.second)}"


def _labels(scores: Sequence[ScoreChange], height: Callable[[float], float]) -> list[Markup]:
    """Return the names of the largest changes in colour, beside their ends, none on another."""
    coloured = [score for score in scores if score.verdict.more_than_chance]
    largest = sorted(coloured, key=lambda score: score.relative)[-MOST_NAMED:]
    named = sorted(largest, key=lambda score: height(score.second))
    labels: list[Markup] = []
    last = float(TOP - GAP)
    for place, score in enumerate(named):
        room = BOTTOM - GAP * (len(named) - 1 - place)
        last = min(max(height(score.second), last + GAP), room)
        labels.append(_text(RIGHT + 8, last + 4, _describe_change(score), "start"))
    return labels


def _text(x: float, y: float, text: str, anchor: str) -> Markup:
    return Markup('<text x="{}" y="{:.1f}" text-anchor="{}">{}</text>').format(
        x, y, anchor, escape(text)
    )


def _digits(value: float) -> str:
    return f"{value:.3g}".replace("-", MINUS)
