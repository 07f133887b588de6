"""What a model needs besides recordings to learn from: every need, whole in one place.

A model names its needs in its attribute ``needs``. The planner, the conformance kit, the catalogue
and ``mocapbench fill`` read them here, so that a new need is one entry of `NEEDS`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from mocapbench.baselines.common.markers import markers_of
from mocapbench.datasets import Recording, ToyProcess

__all__ = ["NEEDS", "Need", "PosedProblem", "describe_needs", "find_met_needs", "list_given"]


class PosedProblem(Protocol):
    """What of a problem may decide whether a need is met, or be given to a model."""

    @property
    def train(self) -> Sequence[Recording]:
        """The recordings to learn from."""

    @property
    def process(self) -> ToyProcess | None:
        """The process that generated them, if it is known."""

    @property
    def control(self) -> ToyProcess | None:
        """A process that generated none of them, if there is one."""


def _give_nothing(_: PosedProblem) -> Mapping[str, Any]:
    return {}


class Need(NamedTuple):
    """Something without which a model cannot take part."""

    sentence: str
    """What the model needs, in words that follow "needs"."""
    is_met: Callable[[PosedProblem], bool]
    """Whether a problem has it."""
    give: Callable[[PosedProblem], Mapping[str, Any]] = _give_nothing
    """The keyword arguments of ``fit`` by which a model that has the need receives it."""


def _has_markers(problem: PosedProblem) -> bool:
    return any(markers_of(first.channels, first.units) for first in problem.train[:1])


NEEDS: dict[str, Need] = {
    "coordinates": Need("channels that are the x, y and z of markers or joints", _has_markers),
    "true process": Need(
        "the process that generated the recordings",
        lambda problem: problem.process is not None,
        lambda problem: {"process": problem.process},
    ),
    "unrelated process": Need(
        "a process that generated none of the recordings",
        lambda problem: problem.control is not None,
        lambda problem: {"unrelated": problem.control},
    ),
}
"""Every need of a model by its name; a new one is one entry here."""


def find_met_needs(problem: PosedProblem) -> frozenset[str]:
    """Return the names of the needs that a problem meets."""
    return frozenset(name for name, need in NEEDS.items() if need.is_met(problem))


def list_given(needs: Iterable[str], problem: PosedProblem) -> dict[str, Any]:
    """Return the arguments of ``fit``, besides recordings, of a model with these needs."""
    return {key: value for name in needs for key, value in NEEDS[name].give(problem).items()}


def describe_needs(needs: Iterable[str]) -> list[str]:
    """Return the sentences of needs; of an unknown one, its name.

    Examples
    --------
    >>> from mocapbench.baselines.declarations.needs import describe_needs
    >>> describe_needs({"true process"})
    ['the process that generated the recordings']
    """
    return [NEEDS[name].sentence if name in NEEDS else repr(name) for name in sorted(needs)]
