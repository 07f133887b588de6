"""Filling the upper body of a walker from the lower legs (HLM §4.3, Figure 4).

W. Pan and L. Torresani, *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML 2009.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.hlm_recordings import (
    CMU,
    SYNTHETIC,
    Styles,
    read_features,
    select_subject,
)
from mocapbench.benchmark.tasks.pages.upper_body_missing import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Mask, Recording

__all__ = ["upper_body_missing", "upper_body_problem"]

N_WALKS = 11
VISIBLE_SEGMENTS = ("root", "tibia", "foot", "toes")


def upper_body_problem(
    styles: Styles, subject: str, seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hold out the fold's walk of ``subject`` and hide the upper body in its second half."""
    recordings = read_features(styles, archive)
    held_out = select_subject(styles, subject)[seeds.fold]
    test = recordings.pop(held_out)
    others = tuple(recordings.values())
    body = JointAngles(archive.skeleton(held_out))
    return ImputeProblem.of_one(test, _upper_body(test), others, seen_in_fit=False, body=body)


def _upper_body(recording: Recording) -> Mask:
    """Return the mask of the paper's 48 joint angles from the middle frame on."""
    n_frames = len(recording.times)
    segments = [channel.partition(".")[0] for channel in recording.channels]
    hidden = [not segment.endswith(VISIBLE_SEGMENTS) for segment in segments]
    return np.outer(np.arange(n_frames) >= n_frames // 2, hidden)


_CASES = (
    Case(
        "subject 07 walks",
        partial(upper_body_problem, CMU, "cmu:07"),
        {"trained on": "subjects 07, 08, 09, 35"},
        tuple(CMU),
        subjects=("07",),
    ),
    Case(
        "synthetic walks",
        partial(upper_body_problem, SYNTHETIC, "gait:01"),
        {"trained on": "three generated walkers"},
        tuple(SYNTHETIC),
        synthetic=True,
    ),
)

upper_body_missing: Task = Task(
    name="upper-body-missing",
    version=1,
    page=PAGE,
    requires={"fills entries", "fills new recordings"},
    cases=_CASES,
    max_folds=N_WALKS,
    profiles={
        "smoke": Profile(
            ("synthetic walks",),
            folds=1,
            budget={"max_iter": 3, "n_restarts": 1, "n_styles": 2},
            opt_in=("best-of", "channel-kriging"),
        ),
        # The held-out gaps of best-of take as long as all others together.
        "quick": Profile(tuple(case.name for case in _CASES), folds=2, opt_in=("best-of",)),
        "paper": Profile(on_recordings(_CASES), folds=N_WALKS),
    },
)
"""48 joint angles are hidden in the second half of a walk never seen before."""
