"""The page of golf swings."""

from __future__ import annotations

from mocapbench.benchmark.figures.filled_channels import FilledChannels
from mocapbench.benchmark.figures.gap_error import GapError
from mocapbench.benchmark.figures.latent_space import LatentSpaces
from mocapbench.benchmark.tasks.gpdm_entrants import WITH_BEST_START
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Golf swings",
    reference="GPDM §5.2, Figures 4 and 9",
    description=(
        "Four swings of one golfer at 30 Hz. Each is held out in turn and models are trained on "
        "the other three; twenty whole frames in a row are hidden. A fold is one of eight "
        "overlapping windows, evenly spread from the fifth frame to the fifth last. Values are "
        "44 joint angles, three root rotations and three root translation differences. The "
        "first error is the mean Euclidean norm per hidden frame, which adds degrees and root "
        "steps; beside it stand its two parts, and the error of the joints in centimetres, by "
        "forward kinematics."
    ),
    metrics=(
        *("rms_per_frame", "mpjpe", "angle_error_per_frame", "root_error_per_frame"),
        *("coverage_95", "msll", "crps"),
    ),
    remarks=(
        "The paper shows models of these swings and fills none of their frames: the protocol is "
        "this project’s own, and there are no published values.",
        "pca-regression and low-rank learn what channels of one frame tell about each other, and "
        "nothing over time: on whole hidden frames they give each channel’s mean in the recording.",
    ),
    illustrated=("64-01", "synthetic"),
    figures=(
        FilledChannels(("rhumerus.rx", "thorax.ry")),
        GapError(),
        LatentSpaces(tuple(entrant.label for entrant in WITH_BEST_START)),
    ),
)
