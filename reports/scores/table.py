"""A table of scores as values: a row for each model, a column for each case."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

__all__ = ["NO_SCORE", "CaseHead", "ScoreCell", "ScoreRow", "ScoreTable"]


@dataclass(frozen=True)
class CaseHead:
    """The head of a column.

    Parameters
    ----------
    name : str
    facts : tuple of str
        What the case varies, such as ``"noise 0.1"``, and remarks on it.
    """

    name: str
    facts: tuple[str, ...] = ()


@dataclass(frozen=True)
class ScoreCell:
    """A number of the table, or why there is none.

    Parameters
    ----------
    text : str
    value : float or None
        The number in full, by which rows are sorted.
    kind : str
        ``""``, ``"best"``, ``"failure"``, ``"absent"`` or ``"published"``: its class in the style
        sheet.
    note : str
        A few words beside the number, such as ``"3 of 5 folds"``.
    link : str
        The address on the page of what is behind it, empty where nothing is.
    """

    text: str
    value: float | None = None
    kind: str = ""
    note: str = ""
    link: str = ""


NO_SCORE = ScoreCell("–", kind="absent")


@dataclass(frozen=True)
class ScoreRow:
    """The scores of one model.

    Parameters
    ----------
    label : str
    kind : str
        ``"ranked"``, ``"reference"`` (a limit or a control, not ranked) or ``"published"`` (a
        model of a paper that no entrant stands for).
    mean : ScoreCell
        Over the cases that enter means.
    behind : ScoreCell
        By how much the mean is worse than the best, with its interval where there is a test.
    strip : Markup or None
        Its values drawn.
    cells : tuple of ScoreCell
        One for each head.
    family : str
    """

    label: str
    kind: str
    mean: ScoreCell
    behind: ScoreCell
    strip: Markup | None
    cells: tuple[ScoreCell, ...]
    family: str = ""


@dataclass(frozen=True)
class ScoreTable:
    """The scores of all models by one metric, best first.

    Parameters
    ----------
    id : str
        Unique on the page.
    metric, title : str
    better : str
        Which values are better: ``"lower"``, ``"higher"`` or ``"near 1"``.
    basis : str
        What the means and intervals rest on.
    mean_head : CaseHead
        The head of the means, which is that of the case where there is but one.
    heads : tuple of CaseHead
    rows : tuple of ScoreRow
    axis : Markup or None
        The axis that the drawings of all rows share.
    notes : tuple of str
    """

    id: str
    metric: str
    title: str
    better: str
    basis: str
    mean_head: CaseHead
    heads: tuple[CaseHead, ...]
    rows: tuple[ScoreRow, ...]
    axis: Markup | None = None
    notes: tuple[str, ...] = ()
