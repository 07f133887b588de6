"""The layout of a task's tables: its page, its rows and its columns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["CaseLayout", "Setting", "TaskLayout"]

Setting = str | int | float

GENERATED = "Generated gait, not recordings of people."


@dataclass(frozen=True)
class CaseLayout:
    """One row of a task's tables.

    Parameters
    ----------
    name : str
        Unique within the task.
    columns : mapping of str to str, int or float
        What distinguishes the row from others; each key becomes a column.
    synthetic : bool
        Whether the case uses generated motion instead of recordings.
    averages_references : bool
        Whether the row is a mean over references that have rows of their own. Those rows then
        count in its place wherever cases are averaged or counted.
    subjects : tuple of str
        Whose recordings the folds are, in turn: one name where all folds are of one subject. Empty
        where motion is generated, or where all cases and folds are draws on the same recordings.
    """

    name: str
    columns: Mapping[str, Setting]
    synthetic: bool = False
    averages_references: bool = False
    subjects: tuple[str, ...] = ()

    def subject(self, fold: int) -> str:
        """Return whose recording a fold is, empty where the case has no subjects."""
        return self.subjects[fold % len(self.subjects)] if self.subjects else ""

    @property
    def heading(self) -> str:
        """The name, marked where the motion is generated."""
        return f"{self.name} (synthetic)" if self.synthetic else self.name

    @property
    def remark(self) -> str:
        """What is said under the name: of a generated case that it is generated."""
        return GENERATED if self.synthetic else ""


@dataclass(frozen=True)
class TaskLayout:
    """The tables of one task: its page, rows and columns.

    Parameters
    ----------
    name : str
    page : TaskPage
    cases : tuple of CaseLayout
        Rows, in table order. Rows without any record are not shown.
    labels : tuple of str
        Entrants, in table order.
    independent_folds : bool
        Whether folds are independent draws of the protocol. Overlapping windows of one recording
        are not: their spread is shown, but it does not measure the uncertainty of the mean.
    budget : str
        What the run reduced (``"max_iter=200"``), empty where it ran the full protocol.
    oracle : str
        The label of the model that knows the generating process. It is a limit and is not ranked.
    control : str
        The label of the negative control: samples of an unrelated process. It is not ranked.
    replay : str
        The label that returns the training recordings as its samples. It is not ranked.
    interpolations : tuple of str
        The labels that fill each channel from its own course alone. The headlines name the best.
    models : mapping of str to ModelInfo
        The model behind each label.
    """

    name: str
    page: TaskPage
    cases: tuple[CaseLayout, ...]
    labels: tuple[str, ...]
    independent_folds: bool = True
    budget: str = ""
    oracle: str = "oracle"
    control: str = "control"
    replay: str = "replay"
    interpolations: tuple[str, ...] = ()
    models: Mapping[str, ModelInfo] = field(default_factory=dict)

    @property
    def ranked(self) -> tuple[str, ...]:
        """The labels that compete: all but the oracle, the control and the replay."""
        unranked = {self.oracle, self.control, self.replay}
        return tuple(label for label in self.labels if label not in unranked)

    @property
    def yours(self) -> tuple[str, ...]:
        """The labels of models of others than us."""
        return tuple(label for label, model in self.models.items() if not model.is_ours)

    def model(self, label: str) -> ModelInfo:
        """Return the model behind ``label``; nothing but the label where nothing is known."""
        return self.models.get(label, ModelInfo(label))
