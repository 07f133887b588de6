"""The page of marker gaps."""

from __future__ import annotations

from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["ALONE", "OTHERS", "PAGE"]

ALONE = "this recording alone"
OTHERS = "others of the subject"

PAGE = TaskPage(
    title="Marker gaps",
    reference="after Gløersen and Federolf 2016",
    description=(
        "Gaps as cameras leave them: the positions of joints, in centimetres, are hidden for "
        "0.1, 0.5, 1 or 2 seconds, in one joint, in an arm or a leg, in five joints at once, or in "
        "three gaps of one joint each. Recordings have 31 joints and 30 frames per second. A fold "
        "is one of four motions (a walk, a kick, a golf swing, punches), with gaps drawn anew "
        "every fourth fold. Models see what is visible of the recording, and three others of the "
        "same subject or none."
    ),
    metrics=("mpjpe", "bone_length_error", "jerk_ratio", "coverage_95", "msll", "crps"),
    along="seconds",
    remarks=(
        "Gløersen and Federolf hide markers on the skin, of walking on a treadmill and of other "
        "gait, at random times and places, and score the mean distance from the measured markers. "
        "Here, joints stand for markers: their positions follow from the database’s joint angles, "
        "so that bones are rigid. The recordings are shorter, and gaps have fixed lengths.",
        "The root’s path on the floor is taken out of all coordinates, as on a treadmill: their "
        "method subtracts the mean of the visible markers. The root is never hidden; the heading "
        "is left as it is.",
        "The joints that are hidden, and where a gap lies between the ends of the recording, "
        "depend on the fold and not on the length of the gap, so that curves compare like with "
        "like. At least five frames on either side stay visible.",
    ),
)
