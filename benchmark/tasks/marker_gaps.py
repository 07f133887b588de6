"""Filling gaps as cameras leave them, in the positions of joints.

After Ø. Gløersen and P. Federolf, *Predicting Missing Marker Trajectories in Human Motion Data
Using Marker Intercorrelations*, PLoS ONE 11(3), 2016.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from mocapbench.benchmark.problems.body import JointPositions
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_runs
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.marker_gaps import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, Skeleton, joint_trajectories, subject_of

__all__ = [
    "LIMBS",
    "N_BESIDE",
    "ChooseJoints",
    "choose_joints",
    "choose_limb",
    "marker_gaps",
    "marker_gaps_problem",
    "place_on_the_spot",
]

RATE = 30
STEP = 4  # from 120 frames per second
SECONDS = (0.1, 0.5, 1.0, 2.0)
LONGEST_RECORDING = 600  # frames at 120 per second
N_BESIDE = 5  # visible frames on either side of a gap, at the least
N_FOLDS = 12

LIMBS: dict[str, tuple[str, ...]] = {
    "left arm": ("lhumerus", "lradius", "lwrist", "lhand", "lfingers", "lthumb"),
    "right arm": ("rhumerus", "rradius", "rwrist", "rhand", "rfingers", "rthumb"),
    "left leg": ("lfemur", "ltibia", "lfoot", "ltoes"),
    "right leg": ("rfemur", "rtibia", "rfoot", "rtoes"),
}

ALONE = "this recording alone"
OTHERS = "others of the subject"

Joints = tuple[str, ...]
ChooseJoints = Callable[[np.random.Generator, Joints], list[Joints]]
"""From random numbers and all joints to those of each gap."""


def choose_joints(rng: np.random.Generator, joints: Joints, *, together: int) -> list[Joints]:
    """Return one gap of some joints, which lie anywhere."""
    return [tuple(rng.choice(joints, size=together, replace=False).tolist())]


def choose_limb(rng: np.random.Generator, joints: Joints) -> list[Joints]:
    """Return one gap of an arm or a leg."""
    del joints  # limbs have names
    return [LIMBS[str(rng.choice(list(LIMBS)))]]


def _several_gaps(rng: np.random.Generator, joints: Joints) -> list[Joints]:
    """Return three gaps of one joint each."""
    return [(str(joint),) for joint in rng.choice(joints, size=3, replace=False)]


PLACES: Mapping[str, ChooseJoints] = {
    "one joint": partial(choose_joints, together=1),
    "a limb": choose_limb,
    "five joints": partial(choose_joints, together=5),
    "three gaps": _several_gaps,
}


Motions = Mapping[str, tuple[str, ...]]
"""Addresses of recordings with gaps, and for each of others of the same subject."""

MOTIONS: Motions = {
    "cmu:35_03": ("cmu:35_01", "cmu:35_02", "cmu:35_04"),  # walking
    "cmu:10_06": ("cmu:10_02", "cmu:10_03", "cmu:10_05"),  # kicking
    "cmu:64_02": ("cmu:64_01", "cmu:64_03", "cmu:64_04"),  # swinging a golf club
    "cmu:02_05": ("cmu:02_01", "cmu:02_06", "cmu:02_10"),  # punching
}
SYNTHETIC: Motions = {
    "gait:01_01": ("gait:01_02", "gait:01_03", "gait:01_06"),
    "gait:02_01": ("gait:02_02", "gait:02_03", "gait:02_04"),
}


def marker_gaps_problem(
    motions: Motions, place: str, seconds: float, seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide joints of the fold's recording.

    The joints, and where between the ends of the recording a gap lies, depend on the place and the
    fold alone: rows that differ in the length of gaps or in training share them.

    Parameters
    ----------
    motions : mapping of str to tuple of str
        Addresses of recordings, and of those that models learn from besides.
    place : str
        Which joints are hidden: a key of `PLACES`.
    seconds : float
        For how long.
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.
    """
    tested = [*motions][seeds.fold % len(motions)]
    skeleton, recording = archive.skeleton(tested), _markers(archive, tested)
    n_hidden = round(RATE * seconds)
    joints = tuple(segment.name for segment in skeleton.segments[1:])
    rng = replace(seeds, address=seeds.address._replace(case=place)).generator("mask")
    runs = [
        (_channels(names), _start(rng.random(), n_hidden, recording), n_hidden)
        for names in PLACES[place](rng, joints)
    ]
    return ImputeProblem.of_one(
        recording,
        hide_runs(runs, recording),
        tuple(_markers(archive, uri) for uri in motions[tested]),
        body=JointPositions(skeleton),
    )


def _markers(archive: Archive, uri: str) -> Recording:
    """Return the joints at 30 frames per second, the root's path on the floor taken out."""
    recording = archive.recording(uri)
    kept = np.arange(0, min(len(recording.times), LONGEST_RECORDING), STEP)
    return place_on_the_spot(archive.skeleton(uri), recording.frames(kept))


def place_on_the_spot(skeleton: Skeleton, recording: Recording) -> Recording:
    """Return the joints' coordinates in cm, the root's path on the floor taken out."""
    others = [name for name in recording.channels if name not in ("root.tx", "root.tz")]
    return joint_trajectories(skeleton, recording.select(others))


def _channels(joints: Joints) -> tuple[str, ...]:
    return tuple(f"{joint}.{axis}" for joint in joints for axis in "xyz")


def _start(place: float, n_hidden: int, recording: Recording) -> int:
    """Return the first hidden frame of a gap that lies at ``place``, 0 to 1, between the ends."""
    room = len(recording.times) - n_hidden - 2 * N_BESIDE
    return N_BESIDE + round(place * room)


def _cases(
    motions: Motions, places: tuple[str, ...], prefix: str = "", *, synthetic: bool
) -> tuple[Case, ...]:
    by_training = {ALONE: dict.fromkeys(motions, ()), OTHERS: motions}
    return tuple(
        Case(
            f"{prefix}{place} {seconds:g} s, {training}",
            partial(marker_gaps_problem, trained_on, place, seconds),
            {"hidden": place, "trained on": training, "seconds": seconds},
            tuple(uri for tested, others in trained_on.items() for uri in (tested, *others)),
            synthetic=synthetic,
            subjects=() if synthetic else tuple(map(subject_of, motions)),
        )
        for place in places
        for training, trained_on in by_training.items()
        for seconds in SECONDS
    )


_CASES = (
    *_cases(MOTIONS, tuple(PLACES), synthetic=False),
    *_cases(SYNTHETIC, ("a limb",), "synthetic ", synthetic=True),
)

_SLOW = ("hgp", "mohgp")
"""Models that take minutes for 93 outputs."""
_IN_QUICK = (0.5, 2.0)
"""Seconds of gaps that the quick profile has, as thirty people have all of them."""
_NOT_QUICK = (*_SLOW, "cyclic-alignment", "gp-independent", "lmc-independent", "moa")
"""Models that take a second or more for each of the default profile's many jobs."""

marker_gaps: Task = Task(
    name="marker-gaps",
    version=1,
    page=PAGE,
    requires={"fills entries"},
    cases=_CASES,
    meets={"coordinates"},
    max_folds=N_FOLDS,
    profiles={
        "smoke": Profile(
            (f"synthetic a limb 0.5 s, {OTHERS}",),
            folds=1,
            budget={"max_iter": 2, "n_restarts": 1},
            opt_in=(*_NOT_QUICK, "best-of"),
        ),
        "quick": Profile(
            (
                *(f"a limb {seconds:g} s, {OTHERS}" for seconds in _IN_QUICK),
                f"synthetic a limb 0.5 s, {OTHERS}",
            ),
            folds=4,
            budget={"max_iter": 10, "n_restarts": 1},
            opt_in=(*_NOT_QUICK, "best-of"),
        ),
        "paper": Profile(on_recordings(_CASES), folds=4, budget={"max_iter": 50}, opt_in=_SLOW),
    },
)
"""Joints are hidden for a tenth of a second to two seconds, one, a limb or several at once."""
