"""Tasks: named, versioned protocols with cases, folds and entrants, declared as values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING, Any

from mocapbench.baselines.declarations.needs import describe_needs
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive
from mocapbench.reports.bundle.task_page import TaskPage

if TYPE_CHECKING:
    from mocapbench.baselines import Model

__all__ = ["PROFILES", "Case", "Entrant", "PoseProblem", "Profile", "Task", "on_recordings"]

PROFILES = ("smoke", "quick", "paper")
"""The names of profiles, by what they cost."""

PoseProblem = Callable[[Seeds, Archive], Problem[Any]]
"""From the streams of a fold and the recordings to a problem: a pure function of both."""


@dataclass(frozen=True, eq=False)
class Case:
    """One row of a task's table.

    Parameters
    ----------
    name : str
        Unique within the task; part of keys, and of seeds unless there is a ``problem_name``.
    problem : callable
        ``problem(seeds, archive)`` poses the problem of the fold ``seeds.fold``: usually a
        ``functools.partial`` of a function that several cases share. What it draws comes from
        ``seeds`` alone, and what it reads from ``archive`` alone.
    columns : mapping of str to str, int or float
        What the row varies, as columns of its table.
    given : tuple of str
        Addresses of the recordings that models see of it, such as ``cmu:02_01``.
    references : tuple of str
        Addresses of the recordings that no model sees, and that solutions are compared with.
    problem_name : str
        Cases that differ only in their references pose one problem: they share its name, and with
        it their seeds and fits. Their ``problem`` binds the references as a keyword argument
        ``references``, the one argument that may differ. By default the case's own name.
    training : str
        Where models learn from the same recordings in all folds, a name of these recordings. Cases
        may share it. What a model learns is then the same in all of them, its seed included, and
        it is fitted once.
    synthetic : bool
        Whether it stands on generated gait rather than recordings of people.
    subjects : tuple of str
        Whose recordings its folds are, in turn: one name where all folds are of one subject. The
        report counts each subject once. Empty for generated motion, and where all cases and folds
        of the task are draws on the same recordings.
    parameters : mapping
        Parameters set on every model that has them, for example ``{"n_styles": 4}``.
    given_by_fold : tuple of tuple of str
        Where folds take recordings of their own, what models see in each, in turn. A fold whose
        recordings are missing then keeps no other from being run.
    training_by_fold : tuple of str
        Where folds fall into groups that learn from the same recordings each, the names of these,
        in turn.
    """

    name: str
    problem: PoseProblem
    columns: Mapping[str, str | int | float] = field(default_factory=dict)
    given: tuple[str, ...] = ()
    references: tuple[str, ...] = ()
    problem_name: str = ""
    training: str = ""
    synthetic: bool = False
    subjects: tuple[str, ...] = ()
    parameters: Mapping[str, object] = field(default_factory=dict)
    given_by_fold: tuple[tuple[str, ...], ...] = ()
    training_by_fold: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        given = self.given or tuple(dict.fromkeys(chain.from_iterable(self.given_by_fold)))
        object.__setattr__(self, "given", given)
        object.__setattr__(self, "problem_name", self.problem_name or self.name)

    @property
    def shares_problem(self) -> bool:
        """Whether other cases may pose the same problem."""
        return self.problem_name != self.name

    @property
    def recordings(self) -> tuple[str, ...]:
        """Addresses of all recordings that it takes, each once."""
        return tuple(dict.fromkeys((*self.given, *self.references)))

    def given_in(self, fold: int) -> tuple[str, ...]:
        """Return the addresses of the recordings that models see in a fold."""
        groups = self.given_by_fold or (self.given,)
        return groups[fold % len(groups)]

    def recordings_in(self, fold: int) -> tuple[str, ...]:
        """Return the addresses of all recordings that a fold takes, each once."""
        return tuple(dict.fromkeys((*self.given_in(fold), *self.references)))

    def training_in(self, fold: int) -> str:
        """Return the name of what models learn from in a fold, empty where others do not."""
        names = self.training_by_fold or (self.training,)
        return names[fold % len(names)]


def on_recordings(cases: Iterable[Case]) -> tuple[str, ...]:
    """Return the names of the cases that stand on recordings of people, not on generated gait."""
    return tuple(case.name for case in cases if not case.synthetic)


@dataclass(frozen=True)
class Entrant:
    """A model with parameters, under the label that tables, records and seeds use."""

    label: str
    model: str
    parameters: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Profile:
    """What a profile (``smoke``, ``quick``, ``paper``) runs of a task.

    Parameters
    ----------
    cases : tuple of str
        Names of cases.
    folds : int
        How many folds, from the first.
    budget : mapping
        Parameters set on every model that has them, for example ``{"max_iter": 20}``.
    opt_in : tuple of str
        Labels that take part only when they are named.
    """

    cases: tuple[str, ...]
    folds: int
    budget: Mapping[str, object] = field(default_factory=dict)
    opt_in: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Task:
    """A protocol: which problems are posed to which models, and what the report shows of it.

    Parameters
    ----------
    name, version : str, int
        Identity; the version rises whenever the same address would give another problem.
    page : TaskPage
        How the report presents it; nothing in it changes a result.
    requires : set of str
        The abilities that a model must provide; others are not applicable.
    cases : tuple of Case
    profiles : mapping of str to Profile
    entrants : tuple of Entrant
        Configured models; a registered model without an entry enters with its defaults.
    meets : set of str
        The needs of models that its problems meet.
    max_folds : int or None
        How many folds there are, None where each draws anew.
    independent_folds : bool
        Whether folds are independent draws of the protocol, as overlapping windows are not.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.benchmark import Case, ImputeProblem, Profile, Task, hide_frames
    >>> from mocapbench.datasets import Recording
    >>> from mocapbench.reports import TaskPage
    >>> def gap_in_a_wave(seeds, archive):
    ...     times = np.linspace(0.0, 1.0, 30)
    ...     phase = seeds.generator("data").uniform(0.0, 1.0)
    ...     values = np.sin(2 * np.pi * (times[:, None] + phase))
    ...     wave = Recording("wave", times, values, ("height",), ("",))
    ...     hidden = hide_frames(10, 20, 30, 1)
    ...     return ImputeProblem.of_one(wave, hidden)
    >>> task = Task(
    ...     name="wave",
    ...     version=1,
    ...     requires={"fills frames"},
    ...     cases=(Case("gap of 10", gap_in_a_wave),),
    ...     profiles={"quick": Profile(("gap of 10",), folds=3)},
    ...     page=TaskPage(
    ...         title="A wave", reference="", description="Fill a gap.", metrics=("mse",)
    ...     ),
    ... )
    >>> task.case("gap of 10").problem_name
    'gap of 10'
    """

    name: str
    version: int
    page: TaskPage
    requires: Set[str]
    cases: tuple[Case, ...]
    profiles: Mapping[str, Profile]
    entrants: tuple[Entrant, ...] = ()
    meets: Set[str] = frozenset()
    max_folds: int | None = None
    independent_folds: bool = True

    def accepts(self, model: Model) -> bool:
        """Return whether ``model`` provides what the task requires, which meets what it needs."""
        return set(self.requires) <= model.provides and not self.list_unmet(model)

    def list_unmet(self, model: Model) -> list[str]:
        """Return the sentences of what ``model`` needs and the task does not have."""
        return describe_needs(model.needs.difference(self.meets))

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

    def averages_references(self, case: Case) -> bool:
        """Return whether ``case`` averages over references that other cases have one by one."""
        alone = {
            other.references for other in self.cases if other.problem_name == case.problem_name
        }
        single = {(reference,) for reference in case.references}
        return len(single) > 1 and single <= alone

    def profile(self, name: str) -> Profile:
        """Return what the profile ``name`` runs of this task.

        Raises
        ------
        UnknownNameError
            If the task has no such profile.
        """
        if name not in self.profiles:
            raise UnknownNameError(f"profile of {self.name}", name, tuple(self.profiles))
        return self.profiles[name]
