"""Tasks: named, versioned protocols with cases, folds and entrants."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from mocapbench.baselines import Informed, Misinformed, Model
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["Case", "Entrant", "Selection", "Task", "without_stand_ins"]

Setting = str | int | float


@dataclass(frozen=True)
class Case:
    """One row of the paper's table.

    Parameters
    ----------
    name : str
        Unique within the task; part of keys, and of seeds unless there is a ``question``.
    settings : mapping
        What the row varies, as columns of its table.
    sources : tuple of str
        Addresses of the recordings that models see of it, such as ``cmu:02_01``.
    references : tuple of str
        Addresses of the recordings that no model sees, which its answers are judged by.
    question : str
        What is asked of models, where other cases ask the same and differ in what the answers are
        judged by: its seeds and fits are shared under this name.
    published : str or None
        The row's name in the published values, None where the paper has no such row.
    synthetic : bool
        Whether it stands on generated gait rather than recordings of people.
    remark : str
        Shown where its numbers stand.
    parameters : mapping
        What it sets on every model that has it, for example ``{"n_styles": 4}``.
    not_comparable : mapping of str to str
        By label, why the row's published values cannot be set beside ours.
    """

    name: str
    settings: Mapping[str, Setting]
    sources: tuple[str, ...] = ()
    references: tuple[str, ...] = ()
    question: str = ""
    published: str | None = None
    synthetic: bool = False
    remark: str = ""
    parameters: Mapping[str, object] = field(default_factory=dict)
    not_comparable: Mapping[str, str] = field(default_factory=dict)

    @property
    def needs(self) -> tuple[str, ...]:
        """Addresses of all recordings that it takes, each once."""
        return tuple(dict.fromkeys((*self.sources, *self.references)))

    @property
    def asked(self) -> str:
        """What seeds and fits know it by."""
        return self.question or self.name


def without_stand_ins(cases: Iterable[Case]) -> tuple[str, ...]:
    """Return the names of the cases that do not stand on generated gait."""
    return tuple(case.name for case in cases if not case.synthetic)


@dataclass(frozen=True)
class Entrant:
    """A model with parameters, under the label that tables, records and seeds use."""

    label: str
    model: str
    parameters: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Selection:
    """What a profile runs of a task.

    Parameters
    ----------
    cases : tuple of str
        Names of cases.
    folds : int
        How many folds, from the first.
    budget : mapping
        Parameters set on every model that has them, for example ``{"max_iter": 20}``.
    without : tuple of str
        Labels that take part only when they are asked for.
    """

    cases: tuple[str, ...]
    folds: int
    budget: Mapping[str, object] = field(default_factory=dict)
    without: tuple[str, ...] = ()


class Task(ABC):
    """A protocol: from an address (case, fold) and seeds to a `Problem`.

    Attributes
    ----------
    name, version : str, int
        Identity; the version rises whenever the same address would give another problem.
    title, reference, description : str
        Heading, place in the paper, and one or two sentences for readers of the report.
    kind : str
        ``"impute"``, ``"synthesise"``, ``"cluster"`` or ``"recover"``: what the report calls it.
    requires : tuple of type
        The abilities a model must have; others are not applicable.
    has_process : bool
        Whether its data come from a known process, which informed models need.
    has_control : bool
        Whether its problems come with an unrelated process, which misinformed models need.
    cases : tuple of Case
    max_folds : int or None
        How many folds there are, None where each draws anew.
    independent_folds : bool
        Whether folds are independent draws of the protocol, as overlapping windows are not.
    entrants : tuple of Entrant
        Configured models; a registered model without an entry enters with its defaults.
    metrics : tuple of str
        The tables to show, in order; the first is the one that headlines speak of.
    profiles : mapping of str to Selection
    published_models, published_metrics : mapping of str to str
        From our labels and metrics to the paper's names.
    not_comparable : mapping of (label, metric) to str
        Why a published value cannot be set beside ours; metric ``"*"`` stands for all.
    exempt : mapping of str to str
        Labels whose samples need not resemble the references more than the control's do, and why.
    remarks : tuple of str
        Errata and cautions shown with the tables.
    crossed : tuple of two str, or None
        Settings along the rows and the columns of its tables, where one entrant takes part and
        the cases are pairs.
    illustrated : tuple of str
        Names of cases; the first of them that has solutions is shown in figures.
    illustrated_channels : tuple of str
        The channels that figures of recordings show.
    coregionalisation_of : tuple of str
        Labels whose coregionalisation matrices are shown.
    latent_of : tuple of str
        Labels whose latent spaces are shown.
    joint_groups : mapping of str to tuple of str
        Joints whose part of those matrices is shown by itself, by a name for the group.
    """

    name: str
    version: int
    title: str
    reference: str
    description: str
    kind: str = "impute"
    requires: tuple[type[Model], ...]
    has_process: bool = False
    has_control: bool = False
    cases: tuple[Case, ...]
    max_folds: int | None = None
    independent_folds: bool = True
    entrants: tuple[Entrant, ...] = ()
    metrics: tuple[str, ...]
    profiles: Mapping[str, Selection]
    published_models: Mapping[str, str] = {}
    published_metrics: Mapping[str, str] = {}
    not_comparable: Mapping[tuple[str, str], str] = {}
    exempt: Mapping[str, str] = {}
    remarks: tuple[str, ...] = ()
    crossed: tuple[str, str] | None = None
    illustrated: tuple[str, ...] = ()
    illustrated_channels: tuple[str, ...] = ()
    coregionalisation_of: tuple[str, ...] = ()
    latent_of: tuple[str, ...] = ()
    joint_groups: Mapping[str, tuple[str, ...]] = {}

    @abstractmethod
    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> Problem:
        """Return the problem of ``case`` at fold ``seeds.fold``: a pure function of all three.

        Raises
        ------
        RecordingUnavailable
            If a recording that the case needs is not at hand.
        """

    def accepts(self, model: type[Model]) -> bool:
        """Return whether ``model`` has what the task requires, and the task what it requires."""
        able = all(issubclass(model, ability) for ability in self.requires)
        informed = self.has_process or not issubclass(model, Informed)
        misinformed = self.has_control or not issubclass(model, Misinformed)
        return able and informed and misinformed

    def case(self, name: str) -> Case:
        """Return the case called ``name``.

        Raises
        ------
        UnknownNameError
            If there is none.
        """
        for case in self.cases:
            if case.name == name:
                return case
        raise UnknownNameError(f"case of {self.name}", name, [case.name for case in self.cases])

    def pools(self, case: Case) -> bool:
        """Return whether others ask the same and are about each of the references of ``case``."""
        alone = {each.references for each in self.cases if each.asked == case.asked}
        single = {(reference,) for reference in case.references}
        return len(single) > 1 and single <= alone

    def selection(self, profile: str) -> Selection:
        """Return what ``profile`` runs of this task.

        Raises
        ------
        UnknownNameError
            If the task has no such profile.
        """
        if profile not in self.profiles:
            raise UnknownNameError(f"profile of {self.name}", profile, tuple(self.profiles))
        return self.profiles[profile]
