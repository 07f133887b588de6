"""Filling the upper body of a walker from the lower legs (HLM §4.3, Figure 4)."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import Imputer, Inductive
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.tasks.base import Case, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Mask, Recording

__all__ = ["UpperBodyMissing", "upper_body_missing"]

N_WALKS = 11
VISIBLE_SEGMENTS = ("root", "tibia", "foot", "toes")

# Of each case, the recordings and the subject whose walks are held out.
_WALKS = {"subject 07 walks": (CMU, "cmu:07"), "synthetic walks": (SYNTHETIC, "gait:01")}
_ANOTHER_WALK = "the paper scores one walk, which it does not name; ours is a mean over walks"


class UpperBodyMissing(Task):
    """HLM §4.3: 48 joint angles are hidden in the second half of a walk never seen before."""

    name = "upper-body-missing"
    version = 1
    title = "Upper body missing"
    reference = "HLM §4.3, Figure 4"
    description = (
        "Each of eleven walks of one subject is held out in turn, and models are trained on the "
        "other recordings: walks, slow walks, strides and runs of this and other subjects, at "
        "30 Hz. In the second half of the walk that is held out, 48 joint angles are hidden: the "
        "trunk, the head, the arms and the hips. The root, the knees, the feet and the toes stay "
        "visible. MSE is the mean squared error per joint angle, in squared degrees."
    )
    requires = (Imputer, Inductive)
    cases = (
        Case(
            "subject 07 walks",
            {"trained on": "subjects 07, 08, 09, 35"},
            CMU.sources,
            published="subject 07 walk",
        ),
        Case(
            "synthetic walks",
            {"trained on": "three generated walkers"},
            SYNTHETIC.sources,
            synthetic=True,
            remark="Generated gait, not recordings of people.",
        ),
    )
    max_folds = N_WALKS
    metrics = ("mse", "msll")
    profiles = {
        "smoke": Selection(
            ("synthetic walks",), folds=1, budget={"max_iter": 3, "n_restarts": 1, "n_styles": 2}
        ),
        "quick": Selection(tuple(case.name for case in cases), folds=3),
        "paper": Selection(without_stand_ins(cases), folds=N_WALKS),
    }
    illustrated = tuple(case.name for case in cases)
    illustrated_channels = ("rhumerus.rx", "thorax.ry")
    published_models = {"nn": "NN", "cyclic-alignment": "HLM"}
    published_metrics = {"mse": "MSE per joint"}
    not_comparable = dict.fromkeys([("nn", "*"), ("cyclic-alignment", "*")], _ANOTHER_WALK)
    remarks = (
        "A fold is a walk. Each is trained on the ten others of the same subject, so folds are not "
        "wholly independent, and the intervals are a little too narrow.",
        "Joint angles are taken within half a turn of zero: in 08_01 the right thumb makes three "
        "whole turns in a tenth of a second. The paper’s angles have no discontinuities either.",
    )

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ImputeProblem:
        """Hold out the fold's walk and hide the upper body in its second half."""
        corpus, subject = _WALKS[case.name]
        held_out = corpus.of_subject(subject)[seeds.fold]
        recordings = corpus.read(archive)
        test = recordings.pop(held_out)
        return ImputeProblem(
            train=tuple(recordings.values()),
            process=None,
            given=(test.hide(_upper_body(test)),),
            truth=(test.values,),
            unit=Unit.natural(len(test.channels)),
        )


def _upper_body(recording: Recording) -> Mask:
    """Return the mask of the paper's 48 joint angles from the middle frame on."""
    n_frames = len(recording.times)
    segments = [channel.partition(".")[0] for channel in recording.channels]
    hidden = [not segment.endswith(VISIBLE_SEGMENTS) for segment in segments]
    return np.outer(np.arange(n_frames) >= n_frames // 2, hidden)


upper_body_missing = UpperBodyMissing()
