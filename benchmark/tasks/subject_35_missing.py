"""Filling a leg or the upper body of subject 35 from 31 recordings of the same person.

- G. W. Taylor, G. E. Hinton and S. T. Roweis, *Modeling Human Motion Using Binary Latent
  Variables*, NIPS 19, 2006.
- N. D. Lawrence, *Learning for Larger Datasets with the Gaussian Process Latent Variable Model*,
  AISTATS, 2007.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.subject_35_missing import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import (
    Archive,
    Mask,
    Recording,
    subject_of,
    taylor_deviations,
    taylor_features,
    taylor_scales,
)

__all__ = ["subject_35_missing", "subject_35_problem"]

_TRIALS = (*range(1, 18), *range(19, 27), 28, *range(30, 35))
TRAINING = tuple(f"cmu:35_{trial:02}" for trial in _TRIALS)
TEST = "cmu:35_29"
SYNTHETIC_TRAINING = tuple(f"gait:01_{trial:02}" for trial in (1, 2, 6, 7, 11, 12))
SYNTHETIC_TEST = "gait:01_16"

_ARM = ("humerus", "radius", "wrist", "hand", "thumb")
PARTS: dict[str, tuple[str, ...]] = {
    "right leg": ("rfemur", "rtibia", "rfoot", "rtoes"),
    "upper body": (
        *("thorax", "lowerneck", "upperneck", "head"),
        *(f"{side}{segment}" for side in "lr" for segment in _ARM),
    ),
}
"""Segments that are hidden: 7 joint angles and 30."""


def subject_35_problem(
    training: tuple[str, ...], test_uri: str, part: str, seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide the ``part`` in the second half of the test recording; every fold is the same."""
    del seeds  # nothing is drawn
    test = taylor_features(archive.recording(test_uri))
    return ImputeProblem(
        train=tuple(taylor_features(archive.recording(uri)) for uri in training),
        given=(test.hide(_second_half(test, part)),),
        truth=(test.values,),
        unit=_natural_unit(),
        scales=np.array([taylor_scales().get(name, np.nan) for name in test.channels]),
    )


def _second_half(recording: Recording, part: str) -> Mask:
    """Return the mask of the part's joint angles from the middle frame on."""
    n_frames = len(recording.times)
    hidden = [channel.partition(".")[0] in PARTS[part] for channel in recording.channels]
    return np.outer(np.arange(n_frames) >= n_frames // 2, hidden)


def _natural_unit() -> Unit:
    """Return degrees for joint angles, and for the root what its values were divided from."""
    angles = [name in taylor_scales() for name in taylor_deviations()]
    deviations = np.array([*taylor_deviations().values()])
    scale = np.where(angles, np.deg2rad(1.0), 1.0) / deviations
    return Unit(np.zeros_like(scale), scale)


def _real(part: str) -> Case:
    columns = {"hidden": part, "trained on": "31 recordings of subject 35"}
    problem = partial(subject_35_problem, TRAINING, TEST, part)
    return Case(part, problem, columns, (TEST, *TRAINING), subjects=(subject_of(TEST),))


def _synthetic(part: str) -> Case:
    columns = {"hidden": part, "trained on": "six recordings of a generated walker"}
    problem = partial(subject_35_problem, SYNTHETIC_TRAINING, SYNTHETIC_TEST, part)
    given = (SYNTHETIC_TEST, *SYNTHETIC_TRAINING)
    return Case(f"synthetic {part}", problem, columns, given, synthetic=True)


_CASES = (*map(_real, PARTS), *map(_synthetic, PARTS))

subject_35_missing: Task = Task(
    name="subject-35-missing",
    version=1,
    page=PAGE,
    requires={"fills entries", "fills new recordings"},
    cases=_CASES,
    entrants=(
        Entrant("nn-scaled", "nn"),
        Entrant("nn-radians", "nn", {"weights": dict(taylor_deviations())}),
    ),
    max_folds=1,
    profiles={
        "smoke": Profile(
            ("synthetic right leg",),
            folds=1,
            budget={"max_iter": 3, "n_restarts": 1, "n_styles": 2},
            opt_in=("best-of",),
        ),
        "quick": Profile(
            tuple(case.name for case in _CASES),
            folds=1,
            budget={"n_restarts": 1, "max_iter": 10},
            opt_in=("best-of",),
        ),
        "paper": Profile(on_recordings(_CASES), folds=1),
    },
)
"""Seven or 30 joint angles are hidden in the second half of a recording never seen before."""
