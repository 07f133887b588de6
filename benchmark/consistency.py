"""Whether a task can be run: its rows told apart, its entrants made, and its page shown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from numbers import Integral

from mocapbench.baselines import ABILITIES, NEEDS
from mocapbench.benchmark.errors import UnregisteredNameError, UsageError
from mocapbench.benchmark.registry import METRICS, MODELS
from mocapbench.benchmark.tasks.base import Entrant, Task

__all__ = ["require_consistent"]


def require_consistent(task: Task) -> None:
    """Refuse a task whose results would be mixed up, or that could not be run or shown.

    Raises
    ------
    UsageError
        If two entrants or cases share a name, a label is empty, has a slash or is the name of
        another model, a model has no such parameter, an ability or need is unknown, a profile has
        no case or no fold, or the page shows no metric or one that is not registered.
    UnregisteredNameError
        If a model is not registered.
    """
    _require_distinct(task, "case", [case.name for case in task.cases])
    _require_distinct(task, "entrant", [entrant.label for entrant in task.entrants])
    for entrant in task.entrants:
        _require_label(task, entrant)
        _require_parameters(task, entrant)
    _require_known(task, "abilities", task.requires, ABILITIES)
    _require_known(task, "needs", task.meets, NEEDS)
    _require_profiles(task)
    _require_metrics(task)


def _require_known(task: Task, what: str, names: Iterable[str], known: Iterable[str]) -> None:
    unknown = [name for name in names if name not in known]
    if unknown:
        raise UsageError(
            f"task {task.name!r}: expected {what} from mocapbench.baselines "
            f"({', '.join(known)}), got {unknown[0]!r}; correct its name"
        )


def _require_distinct(task: Task, kind: str, names: Sequence[str]) -> None:
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    if twice:
        raise UsageError(
            f"task {task.name!r}: expected every {kind} under a name of its own, got "
            f"{twice[0]!r} twice; rename one"
        )


def _require_label(task: Task, entrant: Entrant) -> None:
    label = entrant.label
    if not label.strip() or "/" in label:
        raise UsageError(
            f"task {task.name!r}: expected entrants with labels, without slashes, got {label!r}; "
            "rename it"
        )
    if label != entrant.model and label in MODELS.names():
        raise UsageError(
            f"task {task.name!r}: expected entrants under labels that are not another model's "
            f"name, got {label!r} for {entrant.model!r}; rename it"
        )


def _require_parameters(task: Task, entrant: Entrant) -> None:
    known = sorted(MODELS.get(entrant.model)().get_params())
    unknown = sorted(set(entrant.parameters) - set(known))
    if unknown:
        raise UsageError(
            f"task {task.name!r}, entrant {entrant.label!r}: expected parameters of "
            f"{entrant.model!r} ({', '.join(known) or 'it has none'}), got {unknown[0]!r}; "
            "correct its name"
        )


def _require_profiles(task: Task) -> None:
    for name, profile in task.profiles.items():
        folds: object = profile.folds
        if not profile.cases:
            raise UsageError(
                f"task {task.name!r}, profile {name!r}: expected one or more cases, got none; name "
                "them in its Profile, or leave the profile out"
            )
        if not isinstance(folds, Integral) or int(folds) < 1:
            raise UsageError(
                f"task {task.name!r}, profile {name!r}: expected a whole number of folds from 1, "
                f"got {folds!r}; change its Profile, or leave the profile out"
            )


def _require_metrics(task: Task) -> None:
    if not task.page.metrics:
        raise UsageError(
            f"task {task.name!r}: expected metrics to show on its page, got none; name one or more "
            "in its TaskPage"
        )
    for name in task.page.metrics:
        if name not in METRICS.names():
            error = UnregisteredNameError(METRICS.kind, name, METRICS.names())
            raise UsageError(f"task {task.name!r}, metrics of its page: {error}")
