"""The page of marker gaps."""

from __future__ import annotations

from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]


PAGE = TaskPage(
    title="Marker gaps",
    reference="after Gløersen and Federolf 2016",
    description=(
        "Gaps as cameras leave them: positions of joints are hidden for 0.1 to 2 seconds, in one "
        "joint, a limb, five joints at once, or three gaps of one joint each. A fold is one of "
        "four motions: a walk, a kick, a golf swing, punches. Models see its visible part, and "
        "three other recordings of the subject or none."
    ),
    question="other-channels",
    metrics=("mpjpe", "bone_length_error", "jerk_ratio", "coverage_95", "msll", "crps"),
    along=("seconds",),
    illustrated=(
        "a limb 1 s, others of the subject",
        "synthetic a limb 0.5 s, others of the subject",
    ),
    figures=(draw_filled_motion,),
    remarks=(
        "Gløersen and Federolf hide skin markers at random times and places, in longer recordings "
        "of treadmill walking and other gait. Here joints stand for markers: they follow from "
        "joint angles, so bones are rigid. Gaps have fixed lengths.",
        "Recordings have 31 joints at 30 frames per second. Gaps are drawn anew every fourth fold.",
        "The root’s path on the floor is taken out of all coordinates, as on a treadmill; their "
        "method subtracts the mean of visible markers. The root is never hidden, and the heading "
        "stays as it is.",
        "Which joints are hidden, and where, depends on the fold and not on the length of the gap, "
        "so that curves compare like with like. At least five frames on either side stay visible.",
    ),
)
