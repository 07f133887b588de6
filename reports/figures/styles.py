"""One hue and one marker for each model, through the whole page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from markupsafe import escape

from mocapbench.reports.bundle.layout import TaskLayout

__all__ = ["N_HUES", "N_SHAPES", "TRUTH", "DrawingStyle", "group_styles", "model_styles"]

N_HUES, N_SHAPES = 10, 6
REFERENCES = ("trivial",)
"""Labels of every task that are drawn in grey, beside those that its layout does not rank."""


@dataclass(frozen=True)
class DrawingStyle:
    """How a model is drawn.

    Parameters
    ----------
    hue : str
        The class of its colour: ``"h0"`` to ``"h9"``, ``"hr"`` or ``"ht"``.
    shape : int
        Its marker, which also sets the dashes of its lines.
    label : str
        The model; empty for what is none, such as the truth.
    """

    hue: str
    shape: int = 0
    label: str = ""

    @property
    def classes(self) -> str:
        """The classes of a group of marks."""
        return f"{self.hue} k{self.shape}"

    @property
    def model(self) -> str:
        """The attribute by which a script finds the marks of a model."""
        return f' data-model="{escape(self.label)}"' if self.label else ""


TRUTH = DrawingStyle("ht")
_TRUTHS = ("truth", "true parent", "in the file")


def group_styles(
    groups: Sequence[str], models: Mapping[str, DrawingStyle]
) -> Mapping[str, DrawingStyle]:
    """Return the style of each group of curves: that of its model, ink for the truth, else any.

    Parameters
    ----------
    groups : sequence of str
        In order of appearance.
    models : mapping of str to DrawingStyle
        As `model_styles` returns them.
    """
    others = [group for group in groups if group not in models and group not in _TRUTHS]
    places = {group: place for place, group in enumerate(others)}
    truths = dict.fromkeys(_TRUTHS, TRUTH)
    anonymous = {
        group: DrawingStyle(f"h{place % N_HUES}", place % N_SHAPES)
        for group, place in places.items()
    }
    return {group: {**models, **truths, **anonymous}[group] for group in groups}


def model_styles(layouts: Sequence[TaskLayout]) -> Mapping[str, DrawingStyle]:
    """Return the style of every label of the page.

    A label takes the hue that fewest labels beside it in a table have, then fewest of the page; of
    the labels with one hue each has its own marker. References, which are not ranked, are grey.

    Parameters
    ----------
    layouts : sequence of TaskLayout

    Returns
    -------
    mapping of str to DrawingStyle
        The first sixty models have styles of their own.
    """
    labels = dict.fromkeys(label for layout in layouts for label in layout.labels)
    references = {label for layout in layouts for label in _references(layout)}
    greys = [label for label in labels if label in references]
    styles = {label: DrawingStyle("hr", i % N_SHAPES, label) for i, label in enumerate(greys)}
    hues: dict[str, int] = {}
    for label in labels:
        if label not in references:
            hue = _hue(hues, _beside(layouts, label))
            shape = Counter(hues.values())[hue] % N_SHAPES
            hues[label], styles[label] = (
                hue,
                DrawingStyle(f"h{hue}", (hue + shape) % N_SHAPES, label),
            )
    return {label: styles[label] for label in labels}


def _references(layout: TaskLayout) -> set[str]:
    return {*layout.labels} - {*layout.ranked} | {*REFERENCES}


def _beside(layouts: Iterable[TaskLayout], label: str) -> Counter[str]:
    """Return how many tables hold each label together with ``label``."""
    return Counter(name for each in layouts if label in each.labels for name in each.labels)


def _hue(hues: Mapping[str, int], beside: Mapping[str, int]) -> int:
    """Return the hue for one more label."""
    near = Counter[int]()
    for label, hue in hues.items():
        near[hue] += beside.get(label, 0)
    used = Counter(hues.values())
    return min(range(N_HUES), key=lambda hue: (used[hue] // N_SHAPES, near[hue], used[hue], hue))
