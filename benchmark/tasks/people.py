"""Filling gaps of many people: joints or whole frames, by models that know them or strangers.

The protocols of papers hold one, four or five people, too few to tell two models apart. Here a fold
is a recording of another person, and the person is the unit of all statistics.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial

import numpy as np

from mocapbench.benchmark.problems.body import Body, JointAngles, JointPositions
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.marker_gaps import (
    N_BESIDE,
    ChooseJoints,
    choose_joints,
    choose_limb,
    place_on_the_spot,
)
from mocapbench.benchmark.tasks.pages.people import (
    IN_BETWEENING,
    IN_BETWEENING_ANGLES,
    LOST_LIMB,
    LOST_LIMB_ANGLES,
    LOST_MARKERS,
    LOST_MARKERS_ANGLES,
)
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import (
    Archive,
    Mask,
    People,
    Recording,
    Skeleton,
    SkeletonUnavailable,
    generated_people,
    gpdm_channels,
    read_people,
)

__all__ = [
    "in_betweening",
    "in_betweening_angles",
    "lost_limb",
    "lost_limb_angles",
    "lost_markers",
    "lost_markers_angles",
    "people_problem",
    "people_tasks",
    "read_excerpt",
    "take_angles",
]

RATE = 30
SECONDS = (0.25, 0.5, 1.0, 2.0)
N_STRANGERS = (3, 10, 30, 100)
N_GAPS = 3  # in a recording, or as many as fit
LONGEST = 240  # frames at 30 per second, from the middle of a recording
N_ROUNDS = 3  # the most recordings that a person is tested on


def _choose_all(rng: np.random.Generator, joints: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return one gap of all joints, the root included: whole frames."""
    del rng  # nothing is drawn
    return [("root", *joints)]


HIDDEN: Mapping[str, ChooseJoints] = {
    "a limb": choose_limb,
    "five joints": partial(choose_joints, together=5),
    "whole frames": _choose_all,
}
"""What a gap hides, by its name."""

Regime = Callable[[People, str], tuple[str, ...]]
"""From people and one of their subjects to what is learnt from in place of the recording itself."""


def _learn_alone(people: People, subject: str) -> tuple[str, ...]:
    """Return no recordings: models learn from what is visible of the one to fill."""
    del people, subject
    return ()


def _learn_from_strangers(people: People, subject: str, *, n: int) -> tuple[str, ...]:
    return people.strangers(subject, n)


def _list_regimes(people: People) -> Mapping[str, Regime]:
    """Return what models may learn from, as far as there are enough recordings."""
    enough = [n for n in N_STRANGERS if n <= people.most_strangers]
    strangers = {f"{n} strangers": partial(_learn_from_strangers, n=n) for n in enough}
    own = {"own": People.own} if any(map(people.own, people.subjects)) else {}
    return {"alone": _learn_alone, **own, **strangers}


Features = Callable[[Skeleton, Recording], Recording]
"""From a skeleton and a recording of it at 30 frames per second to the values of a problem."""


def take_angles(skeleton: Skeleton, recording: Recording) -> Recording:
    """Return 50 channels: joint angles, and the root's translation as differences."""
    del skeleton
    return gpdm_channels(recording)


VALUES: Mapping[str, tuple[Features, Callable[[Skeleton], Body]]] = {
    "positions": (place_on_the_spot, JointPositions),
    "angles": (take_angles, JointAngles),
}
"""What recordings hold, and what places the joints of it in space."""


def people_problem(
    seeds: Seeds,
    archive: Archive,
    *,
    people: People,
    values: str,
    hidden: str,
    seconds: float,
    regime: str,
) -> ImputeProblem:
    """Hide gaps of the recording of a fold.

    What is hidden, and where between the ends of the recording gaps lie, depend on ``hidden``, the
    subject and the round alone: rows that differ in the length of gaps or in training share them.

    Parameters
    ----------
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.
    people : People
    values, hidden : str
        Keys of `VALUES` and `HIDDEN`.
    seconds : float
        The length of a gap.
    regime : str
        ``alone``, ``own`` or, of 3 for instance, ``3 strangers``. Alone, models learn from what is
        visible of the recording to fill.

    Raises
    ------
    FormatError
        If a recording is shorter than a gap, or has no skeleton.
    """
    _, folds = _list_folds(people, regime)
    tested, training, number = folds[seeds.fold % len(folds)]
    features, place = VALUES[values]
    recording = read_excerpt(people, tested, features, archive)
    drawn = Seeds(seeds.root, Address("people", 1, hidden, number)).generator("mask")
    starts = _place_gaps(people, recording, round(RATE * seconds), drawn)
    mask = _hide_gaps(recording, starts, round(RATE * seconds), HIDDEN[hidden], drawn)
    return ImputeProblem.of_one(
        _forget_steps(recording, mask),
        mask,
        tuple(read_excerpt(people, uri, features, archive) for uri in training),
        seen_in_fit=not training,
        body=place(archive.skeleton(tested)),
    )


def read_excerpt(people: People, uri: str, features: Features, archive: Archive) -> Recording:
    """Return the middle of a recording at 30 frames per second, at most eight seconds."""
    try:
        # The same strangers are learnt from in many problems.
        return archive.derive(uri, _cut_excerpt, people.rate(uri) // RATE, features)
    except SkeletonUnavailable as error:
        expected, advice = "a recording with a skeleton", "add its skeleton, or leave it out"
        raise people.fault(uri, expected, "none", advice) from error


def _cut_excerpt(archive: Archive, uri: str, step: int, features: Features) -> Recording:
    """Return features of the middle of a recording, of which every so many frames are kept."""
    recording = archive.recording(uri)
    kept = np.arange(0, len(recording.times), step)
    before = max(len(kept) - LONGEST, 0) // 2
    kept = kept[before : before + LONGEST]
    values = recording.values[kept]
    at_rate = Recording(
        uri, np.arange(len(kept)) / RATE, values, recording.channels, recording.units
    )
    return features(archive.skeleton(uri), at_rate)


def _place_gaps(
    people: People, recording: Recording, length: int, rng: np.random.Generator
) -> list[int]:
    """Return the first frames of gaps, in order, with visible frames at the ends and between.

    Raises
    ------
    FormatError
        If there is no room for one.
    """
    n_frames, with_next = len(recording.times), length + N_BESIDE
    positions = rng.random(N_GAPS)  # as many for any length, so that what follows is the same
    n_gaps = min(N_GAPS, (n_frames - N_BESIDE) // with_next)
    if n_gaps < 1:
        raise people.fault(
            recording.name,
            f"{with_next + N_BESIDE} frames or more at {RATE} per second, for a gap of {length}",
            str(n_frames),
            "test the person on a longer recording, or leave the person out",
        )
    room = n_frames - N_BESIDE - n_gaps * with_next
    shifts = np.sort(np.floor(positions[:n_gaps] * (room + 1)).astype(int))
    return [N_BESIDE + gap * with_next + int(shift) for gap, shift in enumerate(shifts)]


def _hide_gaps(
    recording: Recording,
    starts: list[int],
    length: int,
    choose: ChooseJoints,
    rng: np.random.Generator,
) -> Mask:
    """Return a mask (N, D) of the gaps, each in joints of its own."""
    owners = np.array([channel.partition(".")[0] for channel in recording.channels])
    joints = tuple(str(name) for name in dict.fromkeys(owners) if name != "root")
    hidden = np.zeros(recording.values.shape, dtype=bool)
    for start in starts:
        (chosen,) = choose(rng, joints)
        hidden[start : start + length] |= np.isin(owners, chosen)
    return hidden


def _forget_steps(recording: Recording, hidden: Mask) -> Recording:
    """Return a recording without the visible frames from which the root steps into hidden ones.

    The step would tell where the root is in the first frame of a gap. These frames are neither
    shown nor asked: a model that fills whole frames takes none that is hidden in part.
    """
    steps = np.isin(recording.channels, ["root.dtx", "root.dty", "root.dtz"])
    into = np.zeros((len(hidden), 1), dtype=bool)
    into[:-1, 0] = (hidden[1:] & ~hidden[:-1])[:, steps].any(axis=1)
    return recording.hide(into)


@cache  # all tasks have the same
def _list_folds(
    people: People, regime: str
) -> tuple[tuple[str, ...], tuple[tuple[str, tuple[str, ...], int], ...]]:
    """Return the persons of folds, and of each fold its recording and those to learn from.

    Last stands its number among the folds of all subjects, as some regimes lack a subject. The
    first recording of each subject comes first, then the second of each, and so on; a subject with
    fewer is tested on one of them again, with other gaps.
    """
    learn = _list_regimes(people)[regime]
    learnt = {subject: learn(people, subject) for subject in people.subjects}
    taught = [subject for subject in learnt if learnt[subject] or learn is _learn_alone]
    folds = tuple(
        (tests[round_ % len(tests)], learnt[subject], round_ * len(learnt) + position)
        for round_ in range(N_ROUNDS)
        for position, subject in enumerate(learnt)
        if subject in taught
        for tests in [people.tests(subject)]
    )
    return tuple(map(people.person, taught)), folds


def _build_case(people: People, values: str, hidden: str, seconds: float, regime: str) -> Case:
    persons, folds = _list_folds(people, regime)
    synthetic = people.library == "gait"
    most = max(len(training) for _, training, _ in folds)
    # To learn from none of others is to learn alone: where curves of others begin.
    learnt_from = "the person" if regime == "own" else "others"
    return Case(
        f"{'synthetic ' if synthetic else ''}{seconds:g} s {regime}",
        partial(
            people_problem,
            people=people,
            values=values,
            hidden=hidden,
            seconds=seconds,
            regime=regime,
        ),
        {"learnt from": learnt_from, "recordings": most, "seconds": seconds},
        synthetic=synthetic,
        subjects=() if synthetic else persons,
        given_by_fold=tuple((tested, *training) for tested, training, _ in folds),
        training_by_fold=tuple(" ".join(training) for _, training, _ in folds),
    )


def people_tasks(*lists: People, prefix: str = "") -> dict[str, Task]:
    """Return the tasks of lists of people, by name.

    Parameters
    ----------
    *lists : People
        Each has cases of its own, with the same names unless it is of generated walkers.
    prefix : str
        Begins the names of the tasks, which are to be others than those that are installed.

    Examples
    --------
    A file that ``--plugin`` names, for a list of your own:

    >>> from mocapbench.benchmark import people_tasks
    >>> from mocapbench.datasets import read_people
    >>> TASKS = people_tasks(read_people(), prefix="our-")
    >>> sorted(TASKS)[:2]
    ['our-in-betweening', 'our-in-betweening-angles']
    """
    tasks = [
        _build_task(f"{prefix}{name}{end}", lists, values, hidden)
        for name, hidden in NAMES.items()
        for values, end in ENDS.items()
    ]
    return {task.name: task for task in tasks}


NAMES = {"lost-limb": "a limb", "lost-markers": "five joints", "in-betweening": "whole frames"}
ENDS = {"positions": "", "angles": "-angles"}
_PAGES = {
    ("positions", "a limb"): LOST_LIMB,
    ("positions", "five joints"): LOST_MARKERS,
    ("positions", "whole frames"): IN_BETWEENING,
    ("angles", "a limb"): LOST_LIMB_ANGLES,
    ("angles", "five joints"): LOST_MARKERS_ANGLES,
    ("angles", "whole frames"): IN_BETWEENING_ANGLES,
}
"""By values and what is hidden."""
_ILLUSTRATED = "1 s 10 strangers"
_TASK_IN_QUICK = ("positions", "a limb")

N_QUICK, N_PAPER = 12, 30
"""Folds of the profiles: people, each with one recording."""
_CASES_IN_QUICK = {"learnt from": "others", "recordings": 10, "seconds": 1.0}

_SLOW = ("best-of", "cyclic-alignment", "gpdm", "gplvm", "fam", "lds")
"""Models that take longer than all others together."""
_NOT_QUICK = (*_SLOW, "channel-kriging")


def _build_task(name: str, lists: tuple[People, ...], values: str, hidden: str) -> Task:
    cases = tuple(
        _build_case(people, values, hidden, seconds, regime)
        for people in lists
        for regime in _list_regimes(people)
        for seconds in SECONDS
    )
    n_folds = N_ROUNDS * max(len(people.subjects) for people in lists)
    illustrated = tuple(case.name for case in cases if case.name.endswith(_ILLUSTRATED))
    needs_frames = HIDDEN[hidden] is _choose_all
    return Task(
        name=name,
        version=1,
        page=replace(_PAGES[values, hidden], illustrated=illustrated),
        requires={"fills frames" if needs_frames else "fills entries", "fills new recordings"},
        cases=cases,
        meets=frozenset({"coordinates"} if values == "positions" else ()),
        max_folds=n_folds,
        profiles=_build_profiles(cases, n_folds, in_quick=(values, hidden) == _TASK_IN_QUICK),
    )


def _is_on_a_curve(case: Case) -> bool:
    """Return whether a case is of one second, or learns alone, from the person or 30 strangers.

    These are the curves along training and along the length of gaps; all others fill the grid.
    """
    one_second, of_person = case.columns["seconds"] == 1.0, case.columns["learnt from"] != "others"
    return one_second or of_person or case.columns["recordings"] in (0, 30)


def _build_profiles(cases: tuple[Case, ...], n_folds: int, *, in_quick: bool) -> dict[str, Profile]:
    everything = tuple(case.name for case in cases)
    short = tuple(case.name for case in cases if _CASES_IN_QUICK.items() <= case.columns.items())
    budget = {"max_iter": 10, "n_restarts": 1}
    curves = on_recordings(filter(_is_on_a_curve, cases))
    paper = Profile(curves or everything, min(N_PAPER, n_folds), {}, _SLOW)
    smoke = Profile(short[-1:] or everything[:1], 1, {"max_iter": 2, "n_restarts": 1}, _SLOW)
    quick = Profile(short or everything, min(N_QUICK, n_folds), budget, _NOT_QUICK)
    return {"smoke": smoke, "paper": paper, **({"quick": quick} if in_quick else {})}


_TASKS = people_tasks(read_people(), generated_people())
lost_limb: Task = _TASKS["lost-limb"]
lost_limb_angles: Task = _TASKS["lost-limb-angles"]
lost_markers: Task = _TASKS["lost-markers"]
lost_markers_angles: Task = _TASKS["lost-markers-angles"]
in_betweening: Task = _TASKS["in-betweening"]
in_betweening_angles: Task = _TASKS["in-betweening-angles"]
