"""What a task's page says: its texts, its place in the paper, and the figures that it shows.

A `TaskPage` holds everything about a task that is presentation and not protocol. A task declares
one, and rewording it changes no problem, no seed and no key.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from mocapbench.reports.bundle.pictures import Picture

__all__ = ["BY_KIND", "QUESTIONS", "Figure", "TaskPage"]

QUESTIONS: Mapping[str, tuple[str, str]] = {
    "hidden-frames": (
        "Fill hidden frames",
        "All channels are hidden for some frames in a row: what happened in between?",
    ),
    "scattered-samples": (
        "Fill scattered samples",
        "Each channel shows a few scattered frames, at times of its own: what is the rest?",
    ),
    "other-channels": (
        "Fill with other channels",
        "Some channels are hidden while others stay visible: what do those tell about them?",
    ),
    "next-frames": (
        "Predict the next frames",
        "A few frames are seen: what comes next?",
    ),
    "invent-motion": (
        "Invent motion",
        "New recordings are drawn: do they resemble motion that the model has not seen?",
    ),
    "find-styles": (
        "Find styles",
        "Recordings come without labels: are those of one style grouped together?",
    ),
    "recover": (
        "Recover the process",
        "The truth is known: how near does what is learnt or measured come to it?",
    ),
}
"""What tasks ask of models: a title and a sentence for readers by name, in page order."""

BY_KIND: Mapping[str, str] = {
    "impute": "hidden-frames",
    "synthesise": "invent-motion",
    "cluster": "find-styles",
    "recover": "recover",
}
"""The question of a task that names none, by the kind of its page."""


class Figure(Protocol):
    """A figure that a page declares and that is drawn from a solved problem.

    What a solved problem is belongs to the harness. This package only draws the pictures.
    """

    def __call__(self, solved: Any, /) -> Sequence[Picture]:
        """Return the pictures of ``solved``, none where it has nothing to show."""
        ...


@dataclass(frozen=True, kw_only=True)
class TaskPage:
    """The presentation of one task.

    Parameters
    ----------
    title, reference : str
        Heading, and place in the paper (``"thesis §5.1.1, Tables 1–3"``).
    description : str
        One or two sentences for readers.
    kind : str
        ``"impute"``, ``"synthesise"``, ``"cluster"`` or ``"recover"``.
    question : str
        Name of what the task asks (``QUESTIONS``), under which the page shows it. By default that
        of its kind; for ``"impute"`` it is ``"hidden-frames"``.
    short : str
        The title in a word or two, under the heading of the question; by default the title.
    metrics : tuple of str
        The tables to show, in order. The headlines use the first.
    published_rows, published_models, published_metrics : mapping of str to str
        From our cases, labels and metrics to the paper's names; what the paper lacks is left out.
    published_mean : str
        The paper's name of the mean over our cases, if it prints one.
    published_folds : mapping of str to sequence of float
        From our cases to the values of the first metric that a paper prints fold by fold.
    not_comparable : mapping of (label, metric) to str
        Why a published value cannot be compared with ours. The metric ``"*"`` stands for all.
    not_comparable_rows : mapping of (case, label) to str
        The same of the values of a label in one case.
    exempt : mapping of str to str
        Labels whose samples need not pass the negative control, and why. The reason completes the
        sentence "label need not pass: it …".
    remarks : tuple of str
        Errata and cautions, shown under the tables.
    crossed : tuple of two str, or None
        The columns of the cases that go along the rows and along the columns of the tables, where
        every case is a pair and only one entrant takes part.
    asks : mapping of str to str
        Names of cases of many people, and what each asks: the first screen answers it in a sentence
        of its own.
    along : tuple of str
        The columns of the cases, of numbers, that figures show scores along: a figure each, with
        one panel for the cases that are alike in all other columns.
    illustrated : tuple of str
        Names of cases. The first of them that has solutions is shown in figures.
    figures : tuple of Figure
        The figures of that case, in page order.

    Raises
    ------
    ValueError
        If there is no such kind or question.
    """

    title: str
    reference: str
    description: str
    kind: str = "impute"
    question: str = ""
    short: str = ""
    metrics: tuple[str, ...]
    published_rows: Mapping[str, str] = field(default_factory=dict)
    published_models: Mapping[str, str] = field(default_factory=dict)
    published_metrics: Mapping[str, str] = field(default_factory=dict)
    published_mean: str = ""
    published_folds: Mapping[str, Sequence[float]] = field(default_factory=dict)
    not_comparable: Mapping[tuple[str, str], str] = field(default_factory=dict)
    not_comparable_rows: Mapping[tuple[str, str], str] = field(default_factory=dict)
    exempt: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    crossed: tuple[str, str] | None = None
    asks: Mapping[str, str] = field(default_factory=dict)
    along: tuple[str, ...] = ()
    illustrated: tuple[str, ...] = ()
    figures: tuple[Figure, ...] = ()

    def __post_init__(self) -> None:
        if self.kind not in BY_KIND:
            raise ValueError(f"kind: expected one of {', '.join(BY_KIND)}, got {self.kind!r}")
        object.__setattr__(self, "short", self.short or self.title)
        object.__setattr__(self, "question", self.question or BY_KIND[self.kind])
        if self.question not in QUESTIONS:
            raise ValueError(
                f"question: expected one of {', '.join(QUESTIONS)}, got {self.question!r}"
            )
