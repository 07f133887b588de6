"""Synthesis of walking, set beside walks of people whom no model has seen."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from itertools import islice

import numpy as np

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.unseen_walkers import UNSEEN_WALKERS_PAGE
from mocapbench.benchmark.tasks.people import read_excerpt, take_angles
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, FrameByChannel, People, generated_people, read_people

__all__ = ["list_walkers", "unseen_walkers", "walkers_problem"]

N_FRAMES = 70  # at 30 a second: what every recording of the list has, two steps of most people
N_SAMPLES = 25
N_REFERENCES, APART = 5, 5  # at most, and in frames
N_LEARNT = (3, 10)
_WALK = re.compile(r"\bwalk\b|\bgait\b")
"""In what a recording shows."""


def list_walkers(people: People) -> dict[str, tuple[str, ...]]:
    """Return the walks of each subject that is tested on one, those in the role test first."""
    walks = {subject: _choose_walks(people, people.tests(subject)) for subject in people.subjects}
    return {
        subject: (*found, *_choose_walks(people, people.others(subject)))
        for subject, found in walks.items()
        if found
    }


def _choose_walks(people: People, uris: Sequence[str]) -> tuple[str, ...]:
    return tuple(uri for uri in uris if _WALK.search(people.shows(uri)))


def _list_strange_walks(people: People, subject: str, n: int) -> tuple[str, ...]:
    """Return the first walks of people who are not tested with a subject."""
    return _choose_walks(people, people.strangers(subject, people.most_strangers))[:n]


def walkers_problem(
    seeds: Seeds, archive: Archive, *, people: People, n_learnt: int
) -> SynthesiseProblem:
    """Learn from walks of strangers to the person of the fold, who is the reference.

    Parameters
    ----------
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.
    people : People
    n_learnt : int
        Of how many walks.
    """
    walkers = list_walkers(people)
    subject = [*walkers][seeds.fold % len(walkers)]
    learnt = _list_strange_walks(people, subject, n_learnt)
    train = tuple(
        read_excerpt(people, uri, take_angles, archive).frames(np.arange(N_FRAMES))
        for uri in learnt
    )
    return SynthesiseProblem(
        train=train,
        times=train[0].times,
        n_samples=N_SAMPLES,
        references=_cut_references(people, walkers[subject], archive),
        body=JointAngles(archive.skeleton(walkers[subject][0])),
    )


def _cut_references(
    people: People, walks: Sequence[str], archive: Archive
) -> tuple[FrameByChannel, ...]:
    """Return the beginnings of a person's walks, then what begins five frames later, and so on."""
    read = [read_excerpt(people, uri, take_angles, archive) for uri in walks[:N_REFERENCES]]
    longest = max(len(walk.times) for walk in read)
    windows = (
        walk.values[start : start + N_FRAMES]
        for start in range(0, longest - N_FRAMES + 1, APART)
        for walk in read
        if start + N_FRAMES <= len(walk.times)
    )
    return tuple(islice(windows, N_REFERENCES))


def _build_case(people: People, n_learnt: int) -> Case:
    walkers, synthetic = list_walkers(people), people.library == "gait"
    learnt = {subject: _list_strange_walks(people, subject, n_learnt) for subject in walkers}
    return Case(
        f"{'synthetic ' if synthetic else ''}{n_learnt} walks",
        partial(walkers_problem, people=people, n_learnt=n_learnt),
        {"recordings": n_learnt},
        synthetic=synthetic,
        subjects=() if synthetic else tuple(map(people.person, walkers)),
        given_by_fold=tuple((*learnt[subject], *walks) for subject, walks in walkers.items()),
        training_by_fold=tuple(map(" ".join, learnt.values())),
    )


_PEOPLE, _GENERATED = read_people(), generated_people()
_CASES = tuple(_build_case(people, n) for people in (_PEOPLE, _GENERATED) for n in N_LEARNT)
_MATERN = {"kernel": "matern32"}
_SLOW = ("gpdm",)
"""What takes minutes to draw from, for each person."""

unseen_walkers: Task = Task(
    name="unseen-walkers",
    version=1,
    page=UNSEEN_WALKERS_PAGE,
    requires={"draws samples"},
    cases=_CASES,
    entrants=(
        Entrant("mohgp-3", "mohgp", {"n_components": 3, "n_restarts": 1, **_MATERN}),
        Entrant("moa-3", "moa", {"n_components": 3, **_MATERN}),
        Entrant("lmc-independent-3", "lmc-independent", {"n_components": 3, **_MATERN}),
    ),
    profiles={
        "smoke": Profile(
            ("synthetic 3 walks",), 1, {"max_iter": 2, "n_restarts": 1}, (*_SLOW, "hgp")
        ),
        "paper": Profile(
            on_recordings(_CASES), len(list_walkers(_PEOPLE)), {"max_iter": 100}, _SLOW
        ),
    },
    max_folds=len(list_walkers(_GENERATED)),
)
