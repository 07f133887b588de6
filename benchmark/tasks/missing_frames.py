"""Filling half a second or more of whole missing frames (GPDM §5.4, Table 2).

J. M. Wang, D. J. Fleet and A. Hertzmann 2008, *Gaussian Process Dynamical Models for Human Motion*.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_frames
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.gpdm_entrants import (
    GPDM_STARTS,
    NOT_QUICK,
    POSE_VITERBI,
    SLOW,
    WITH_BEST_START,
)
from mocapbench.benchmark.tasks.pages.missing_frames import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, gpdm_features, one_based_frames, subject_of

__all__ = ["hide_window", "missing_frames", "missing_frames_problem"]

N_TEST_FRAMES = 50
N_HIDDEN = 31
FIRST_HIDDEN = 4  # frame 5 of the paper, counted from 1
N_WINDOWS = 12

# The paper's frames: counted from 1 at 120 Hz, both ends included.
TRAINING = {
    "cmu:35_02": (55, 338),
    "cmu:10_04": (222, 499),
    "cmu:12_01": (22, 328),
    "cmu:16_15": (62, 342),
}
GROUPS = {
    "four-walkers": tuple(TRAINING),
    "three-walkers": tuple(uri for uri in TRAINING if uri != "cmu:10_04"),
}
TESTS = ("35_03", "12_02", "16_21", "12_03", "07_01", "07_02", "08_01", "08_02")
SYNTHETIC_TRAINING = ("gait:01_01", "gait:02_01", "gait:03_01")
SYNTHETIC_TESTS = ("gait:01_02", "gait:04_01")

_LIKE_OTHERS_HERE = ("hold", "pchip", "pca-regression", "low-rank", "channel-kriging")
"""On whole frames the first two score like ``linear``, the others give the mean or nearly so."""

_IN_GOLF_SWINGS = tuple(entrant.label for entrant in WITH_BEST_START)
"""The smoke profile tries these there, unless their way of learning is tried here."""


def missing_frames_problem(
    test_uri: str, training: tuple[str, ...], seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide the fold's window of the test recording's first fifty frames."""
    test = gpdm_features(archive.recording(test_uri)).frames(np.arange(N_TEST_FRAMES))
    walks = tuple(_training_walk(archive, uri) for uri in training)
    return hide_window(test, walks, seeds.fold, JointAngles(archive.skeleton(test_uri)))


def hide_window(
    test: Recording, training: tuple[Recording, ...], fold: int, body: JointAngles
) -> ImputeProblem:
    """Hide the window of a fold, counted from 0, in fifty frames."""
    start = FIRST_HIDDEN + fold
    given = test.hide(hide_frames(start, start + N_HIDDEN, *test.values.shape))
    return ImputeProblem(
        train=training,
        given=(given,),
        truth=(test.values,),
        unit=Unit.natural(len(test.channels)),
        body=body,
    )


def _training_walk(archive: Archive, uri: str) -> Recording:
    """Return a training walk, cut to the paper's frames where it names them."""
    recording = archive.recording(uri)
    first, last = TRAINING.get(uri, (1, len(recording.times)))
    return gpdm_features(one_based_frames(recording, first, last))


def _case(
    name: str, columns: dict[str, str], test: str, training: tuple[str, ...], *, synthetic: bool
) -> Case:
    problem = partial(missing_frames_problem, test, training)
    return Case(
        name,
        problem,
        columns,
        (test, *training),
        training=columns["training"],
        synthetic=synthetic,
        subjects=() if synthetic else (subject_of(test),),
    )


def _real(trial: str, group: str) -> Case:
    name = trial.replace("_", "-")
    columns = {"recording": name, "training": group}
    return _case(f"{name} {group}", columns, f"cmu:{trial}", GROUPS[group], synthetic=False)


def _synthetic(number: int, uri: str) -> Case:
    columns = {"recording": f"gait {number}", "training": "three generated walkers"}
    return _case(f"synthetic {number}", columns, uri, SYNTHETIC_TRAINING, synthetic=True)


_CASES = (
    *(_real(trial, group) for group in GROUPS for trial in TESTS),
    *(_synthetic(number, uri) for number, uri in enumerate(SYNTHETIC_TESTS, start=1)),
)

missing_frames: Task = Task(
    name="missing-frames",
    version=1,
    page=PAGE,
    requires={"fills frames", "fills new recordings"},
    cases=_CASES,
    entrants=(
        *POSE_VITERBI,
        *GPDM_STARTS,
        Entrant("cyclic-alignment", "cyclic-alignment"),
        Entrant("cyclic-alignment-centred", "cyclic-alignment", {"prior": "centred"}),
    ),
    max_folds=N_WINDOWS,
    independent_folds=False,
    profiles={
        "smoke": Profile(
            ("synthetic 1",),
            folds=1,
            budget={"max_iter": 2, "fill_iter": 10, "n_restarts": 1},
            opt_in=(*SLOW, *_IN_GOLF_SWINGS, "cyclic-alignment-centred", "best-of"),
        ),
        "quick": Profile(
            (*(case.name for case in _CASES if "three" in case.name), "synthetic 1"),
            # Each window begins one frame after the last; `paper` has them all.
            folds=N_WINDOWS // 3,
            budget={"n_restarts": 1, "max_iter": 10, "refine_iter": 3, "fill_iter": 20},
            opt_in=(
                *NOT_QUICK,
                "gpdm-balanced-viterbi",
                "cyclic-alignment-centred",
                "best-of",
                *_LIKE_OTHERS_HERE,
            ),
        ),
        "paper": Profile(on_recordings(_CASES), folds=N_WINDOWS),
    },
)
"""Table 2: 31 of 50 frames are hidden as a whole, in twelve overlapping windows."""
