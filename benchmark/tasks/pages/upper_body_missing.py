"""The page of the missing upper body."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.filled_channels import draw_filled_channels
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

_ANOTHER_WALK = "the paper scores one walk, which it does not name; ours is a mean over walks"

PAGE = TaskPage(
    title="Upper body missing",
    short="Upper body",
    reference="HLM §4.3, Figure 4",
    description=(
        "Each of eleven walks of one subject is held out in turn; models learn from the other "
        "recordings of this and other subjects, at 30 Hz. In its second half, 48 joint angles are "
        "hidden: trunk, head, arms and hips. The root, knees, feet and toes stay visible. MSE is "
        "per joint angle, in squared degrees."
    ),
    question="other-channels",
    metrics=("mse", "mpjpe", "msll"),
    published_rows={"subject 07 walks": "subject 07 walk"},
    published_models={"nn": "NN", "cyclic-alignment": "HLM"},
    published_metrics={"mse": "MSE per joint"},
    not_comparable=dict.fromkeys([("nn", "*"), ("cyclic-alignment", "*")], _ANOTHER_WALK),
    remarks=(
        "A fold is a walk. Each is trained on the ten others of the subject, so folds are not "
        "wholly independent and intervals a little too narrow.",
        "Joint angles are wrapped to [−180°, 180°): in 08_01 the right thumb turns by three times "
        "360° in a tenth of a second. The paper’s angles have no discontinuities either.",
        "The paper gives the functional analysis of motion an error “greater than 200”, without a "
        "number. Here it is fam, with three components; with five, the worst walk exceeds 200.",
    ),
    illustrated=("subject 07 walks", "synthetic walks"),
    figures=(
        draw_filled_motion,
        partial(draw_filled_channels, channels=("rhumerus.rx", "thorax.ry")),
    ),
)
