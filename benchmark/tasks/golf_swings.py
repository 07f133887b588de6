"""Filling missing frames of a golf swing from others of the same golfer: a motion without cycles.

The recordings are those of GPDM Figures 4 and 9; the question is this project's own.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import FrameImputer, Inductive
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.masks import hide_frames
from mocapbench.benchmark.tasks.base import Case, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.gpdm_entrants import NOT_QUICK, POSE_VITERBI, SLOW, WITH_BEST_START
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, gpdm_features, one_based_frames

__all__ = ["GolfSwings", "golf_swings"]

N_HIDDEN = 20
N_BESIDE = 5  # visible frames on either side, at the least
N_WINDOWS = 8

# The paper's frames: counted from 1 at 120 Hz, both ends included.
SWINGS = {"64_01": (120, 400), "64_02": (170, 420), "64_03": (100, 350), "64_04": (80, 315)}
SYNTHETIC = ("gait:01_01", "gait:02_01", "gait:03_01", "gait:04_01")
SYNTHETIC_FRAMES = (1, 240)


def _cases() -> tuple[Case, ...]:
    trials = [f"cmu:{trial}" for trial in SWINGS]
    real = [
        Case(
            trial.replace("_", "-"),
            {"swing": trial.replace("_", "-")},
            (f"cmu:{trial}", *(uri for uri in trials if uri != f"cmu:{trial}")),
        )
        for trial in SWINGS
    ]
    synthetic = Case(
        "synthetic",
        {"swing": "none: a generated walk"},
        SYNTHETIC,
        synthetic=True,
        remark="Generated gait, not recordings of people, and no swing.",
    )
    return (*real, synthetic)


class GolfSwings(Task):
    """Each of four swings is held out in turn, and 20 of its frames are hidden as a whole."""

    name = "golf-swings"
    version = 1
    title = "Golf swings"
    reference = "GPDM §5.2, Figures 4 and 9"
    description = (
        "Four swings of one golfer at 30 Hz. Each is held out in turn and models are trained on "
        "the other three; twenty whole frames in a row are hidden. A fold is one of eight "
        "overlapping windows, evenly spread from the fifth frame to the fifth last. Values are "
        "44 joint angles, three root rotations and three root translation differences; the error "
        "is the mean Euclidean norm per hidden frame."
    )
    requires = (FrameImputer, Inductive)
    cases = _cases()
    max_folds = N_WINDOWS
    independent_folds = False
    entrants = (*POSE_VITERBI, *WITH_BEST_START)
    metrics = ("rms_per_frame",)
    profiles = {
        "smoke": Selection(
            ("synthetic",), folds=1, budget={"max_iter": 2, "fill_iter": 10}, without=SLOW
        ),
        "quick": Selection(
            tuple(case.name for case in cases),
            folds=2,
            budget={"n_restarts": 1, "max_iter": 10, "refine_iter": 3},
            without=(*NOT_QUICK, "gpdm-balanced-viterbi"),
        ),
        "paper": Selection(without_stand_ins(cases), folds=N_WINDOWS),
    }
    remarks = (
        "The paper shows models of these swings and fills none of their frames: the protocol is "
        "this project’s own, and there are no published values.",
    )
    illustrated = ("64-01", "synthetic")
    illustrated_channels = ("rhumerus.rx", "thorax.ry")
    latent_of = tuple(entrant.label for entrant in WITH_BEST_START)

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ImputeProblem:
        """Hide the fold's window of the swing that the case holds out."""
        test, *train = (_swing(archive, uri) for uri in case.sources)
        last = len(test.times) - N_BESIDE - N_HIDDEN
        start = int(np.linspace(N_BESIDE, last, N_WINDOWS).round()[seeds.fold])
        given = test.hide(hide_frames(start, start + N_HIDDEN, *test.values.shape))
        return ImputeProblem(
            train=tuple(train),
            process=None,
            given=(given,),
            truth=(test.values,),
            unit=Unit.natural(len(test.channels)),
            skeleton=archive.read(case.sources[0]).skeleton,
        )


def _swing(archive: Archive, uri: str) -> Recording:
    first, last = SWINGS.get(uri.removeprefix("cmu:"), SYNTHETIC_FRAMES)
    return gpdm_features(one_based_frames(archive.read(uri).recording(uri), first, last))


golf_swings = GolfSwings()
