"""The data of a task: its recordings, and the problems that it poses with those that are here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import singledispatch
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.recover import RecoverProblem
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["Group", "Posed", "posed", "recordings"]

CMU_SUBJECT = "http://mocap.cs.cmu.edu/search.php?subjectnumber="


@dataclass(frozen=True)
class Group:
    """The recordings of one subject of a library.

    Parameters
    ----------
    library, subject : str
    keys : tuple of str
    seen : bool
        Whether models see of them; others are only compared with.
    missing : tuple of str
        Addresses of those that are not on this machine.
    """

    library: str
    subject: str
    keys: Sequence[str]
    seen: bool
    missing: Sequence[str]

    @property
    def link(self) -> str:
        """The address of the library's page on the subject, empty where it has none."""
        return f"{CMU_SUBJECT}{int(self.subject)}" if self.library == "cmu" else ""


class Posed(NamedTuple):
    """The first problem of a case."""

    case: str
    recordings: str
    frames: str
    rate: str
    channels: int
    asked: str


def recordings(task: Task, archive: Archive) -> list[Group]:
    """Return the recordings of a task by library and subject, those that models see first."""
    seen = dict.fromkeys(uri for case in task.cases for uri in case.given)
    others = dict.fromkeys(uri for case in task.cases for uri in case.references if uri not in seen)
    return [*_groups(sorted(seen), archive, seen=True), *_groups(sorted(others), archive)]


def _groups(uris: Iterable[str], archive: Archive, *, seen: bool = False) -> Iterator[Group]:
    for (library, subject), group in groupby(uris, key=_owner):
        members = list(group)
        keys = tuple(uri.partition(":")[2] for uri in members)
        missing = tuple(uri for uri in members if not archive.available(uri))
        yield Group(library, subject, keys, seen, missing)


def _owner(uri: str) -> tuple[str, str]:
    library, _, key = uri.partition(":")
    return library, key.partition("_")[0]


def posed(task: Task, archive: Archive) -> list[Posed]:
    """Return the first problem of the first case on recordings and of the first on generated gait.

    A case whose recordings are not on this machine is left out.
    """
    firsts = {case.synthetic: case for case in reversed(task.cases)}.values()
    here = (case for case in firsts if all(map(archive.available, case.recordings)))
    return [_posed(task, case, archive) for case in sorted(here, key=task.cases.index)]


def _posed(task: Task, case: Case, archive: Archive) -> Posed:
    problem = case.problem(
        Seeds(0, Address(task.name, task.version, case.problem_name, 0)), archive
    )
    lengths = sorted({len(recording.times) for recording in problem.train})
    frames = f"{lengths[0]} to {lengths[-1]}" if len(lengths) > 1 else str(lengths[0])
    first = problem.train[0]
    rate = f"{1 / np.median(np.diff(first.times)):.3g} Hz" if case.recordings else ""
    seen = format_count(len(problem.train), "recording")
    return Posed(case.name, seen, frames, rate, len(first.channels), _asked(problem))


@singledispatch
def _asked(problem: Any) -> str:
    """Return what is asked of a model; nothing is known of other kinds of problems."""
    del problem
    return ""


@_asked.register
def _of_gaps(problem: ImputeProblem) -> str:
    hidden = np.mean([1.0 - recording.visible.mean() for recording in problem.given])
    filled = format_count(len(problem.given), "recording")
    return f"fill {filled}, of whose entries {100 * hidden:.0f} % are hidden"


@_asked.register
def _of_samples(problem: SynthesiseProblem) -> str:
    references = format_count(len(problem.references), "other")
    return f"draw {problem.n_samples} of {len(problem.times)} frames, like {references}"


@_asked.register
def _of_styles(problem: ClusterProblem) -> str:
    return f"group them; they are of {len(set(problem.truth))} styles"


@_asked.register
def _of_layers(problem: RecoverProblem) -> str:
    return f"find the {len(problem.truth)} covariances that they were drawn from"
