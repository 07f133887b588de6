"""The questions that tasks put to models, in the order of the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["BY_KIND", "QUESTIONS", "Question", "question"]


@dataclass(frozen=True)
class Question:
    """What a task asks of models.

    Parameters
    ----------
    name : str
        As a `TaskPage` names it.
    title : str
        Heading.
    ask : str
        One sentence for readers.
    """

    name: str
    title: str
    ask: str


QUESTIONS = (
    Question(
        "hidden-frames",
        "Fill hidden frames",
        "All channels are hidden for some frames in a row: what happened in between?",
    ),
    Question(
        "scattered-samples",
        "Fill scattered samples",
        "Each channel shows a few scattered frames, at times of its own: what is the rest?",
    ),
    Question(
        "other-channels",
        "Fill with other channels",
        "Some channels are hidden while others stay visible: what do those tell about them?",
    ),
    Question(
        "invent-motion",
        "Invent motion",
        "New recordings are drawn: do they resemble motion that the model has not seen?",
    ),
    Question(
        "find-styles",
        "Find styles",
        "Recordings come without labels: are those of one style grouped together?",
    ),
    Question(
        "recover",
        "Recover the process",
        "The truth is known: how near does what is learnt or measured come to it?",
    ),
)
"""Every question, in page order."""

BY_KIND: Mapping[str, str] = {
    "impute": "hidden-frames",
    "synthesise": "invent-motion",
    "cluster": "find-styles",
    "recover": "recover",
}
"""The question of a task that names none, by the kind of its page."""


def question(name: str) -> Question:
    """Return the question called ``name``.

    Raises
    ------
    ValueError
        If there is none.
    """
    for known in QUESTIONS:
        if known.name == name:
            return known
    names = ", ".join(known.name for known in QUESTIONS)
    raise ValueError(f"question: expected one of {names}, got {name!r}")
