"""The page of golf swings."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.filled_channels import draw_filled_channels
from mocapbench.benchmark.figures.latent_space import draw_latent_spaces
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.benchmark.tasks.gpdm_entrants import WITH_BEST_START
from mocapbench.benchmark.tasks.pages.missing_frames import NOTHING_OVER_TIME
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Golf swings",
    reference="GPDM §5.2, Figures 4 and 9",
    description=(
        "Four swings of one golfer at 30 Hz. Each is held out in turn, models learn from the other "
        "three, and twenty whole frames in a row are hidden. A fold is one of eight overlapping "
        "windows. Values are 44 joint angles, three root rotations and three root translation "
        "differences."
    ),
    question="hidden-frames",
    metrics=(
        *("rms_per_frame", "mpjpe", "angle_error_per_frame", "root_error_per_frame"),
        *("coverage_95", "msll", "crps"),
    ),
    remarks=(
        "The paper shows models of these swings and fills none of their frames: the protocol is "
        "this project’s own, without published values.",
        NOTHING_OVER_TIME,
    ),
    illustrated=("64-01", "synthetic"),
    figures=(
        draw_filled_motion,
        partial(draw_filled_channels, channels=("rhumerus.rx", "thorax.ry")),
        partial(draw_latent_spaces, labels=tuple(entrant.label for entrant in WITH_BEST_START)),
    ),
)
