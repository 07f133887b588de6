"""Filling missing frames of a golf swing from others of the same golfer: a motion without cycles.

The recordings are those of GPDM Figures 4 and 9 (Wang, Fleet and Hertzmann 2008, *Gaussian Process
Dynamical Models for Human Motion*); the protocol is this project's own.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_frames
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.gpdm_entrants import NOT_QUICK, POSE_VITERBI, SLOW, WITH_BEST_START
from mocapbench.benchmark.tasks.pages.golf_swings import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, gpdm_features, one_based_frames, subject_of

__all__ = ["golf_problem", "golf_swings"]

N_HIDDEN = 20
N_BESIDE = 5  # visible frames on either side, at the least
N_WINDOWS = 8

# The paper's frames: counted from 1 at 120 Hz, both ends included.
SWINGS = {
    "cmu:64_01": (120, 400),
    "cmu:64_02": (170, 420),
    "cmu:64_03": (100, 350),
    "cmu:64_04": (80, 315),
}
SYNTHETIC = dict.fromkeys(("gait:01_01", "gait:02_01", "gait:03_01", "gait:04_01"), (1, 240))


def golf_problem(
    frames: dict[str, tuple[int, int]], held_out: str, seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide the fold's window of the swing that is held out."""
    swings = {uri: _swing(archive, uri, *window) for uri, window in frames.items()}
    test = swings.pop(held_out)
    last = len(test.times) - N_BESIDE - N_HIDDEN
    start = int(np.linspace(N_BESIDE, last, N_WINDOWS).round()[seeds.fold])
    given = test.hide(hide_frames(start, start + N_HIDDEN, *test.values.shape))
    return ImputeProblem(
        train=tuple(swings.values()),
        given=(given,),
        truth=(test.values,),
        unit=Unit.natural(len(test.channels)),
        body=JointAngles(archive.skeleton(held_out)),
    )


def _swing(archive: Archive, uri: str, first: int, last: int) -> Recording:
    return gpdm_features(one_based_frames(archive.recording(uri), first, last))


def _case(name: str, swing: str, held_out: str, frames: dict[str, tuple[int, int]]) -> Case:
    given = (held_out, *(uri for uri in frames if uri != held_out))
    problem = partial(golf_problem, frames, held_out)
    synthetic = frames is SYNTHETIC
    return Case(
        name,
        problem,
        {"swing": swing},
        given,
        training=f"all but {held_out}",
        synthetic=synthetic,
        subjects=() if synthetic else (subject_of(held_out),),
    )


def _real(uri: str) -> Case:
    name = uri.removeprefix("cmu:").replace("_", "-")
    return _case(name, name, uri, SWINGS)


_CASES = (
    *map(_real, SWINGS),
    _case("synthetic", "none: a generated walk", "gait:01_01", SYNTHETIC),
)

_IN_MISSING_FRAMES = ("gpdm-map-viterbi", "gpdm-fixed-alpha-viterbi", "cyclic-alignment")
"""The smoke profile tries them there, the first two with other starts."""

golf_swings: Task = Task(
    name="golf-swings",
    version=1,
    page=PAGE,
    requires={"fills frames", "fills new recordings"},
    cases=_CASES,
    max_folds=N_WINDOWS,
    independent_folds=False,
    entrants=(*POSE_VITERBI, *WITH_BEST_START),
    profiles={
        "smoke": Profile(
            ("synthetic",),
            folds=1,
            budget={"max_iter": 2, "fill_iter": 10, "n_restarts": 1},
            opt_in=(*SLOW, *_IN_MISSING_FRAMES, "best-of"),
        ),
        "quick": Profile(
            tuple(case.name for case in _CASES),
            folds=2,
            budget={"n_restarts": 1, "max_iter": 10, "refine_iter": 3},
            opt_in=(*NOT_QUICK, "gpdm-balanced-viterbi"),
        ),
        "paper": Profile(on_recordings(_CASES), folds=N_WINDOWS),
    },
)
"""Each of four swings is held out in turn, and 20 of its frames are hidden as a whole."""
