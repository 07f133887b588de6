"""The page of walking, set beside walks of people whom no model has seen."""

from __future__ import annotations

from mocapbench.benchmark.figures.motions.sampled import draw_sampled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["UNSEEN_WALKERS_PAGE"]

UNSEEN_WALKERS_PAGE = TaskPage(
    title="Walking of people never seen",
    short="Unseen walkers",
    reference="this project’s own protocol",
    description=(
        "Models learn from walks of strangers; 25 samples of each are compared with walks of a "
        "person whom they have not seen. A fold is another person. Values are 44 joint angles, "
        "three root rotations and differences of three translations, in 70 frames at 30 a second."
    ),
    kind="synthesise",
    question="invent-motion",
    metrics=("mcc", "mlc", "variance_ratio", "sample_npss", "sample_jerk_ratio"),
    along=("recordings",),
    illustrated=("10 walks", "3 walks", "synthetic 3 walks"),
    figures=(draw_sampled_motion,),
    remarks=(
        "A person’s references are up to five: the beginnings of the recordings that the "
        "database’s index calls walks, then what begins five frames later.",
        "Walks to learn from are of people in the two other groups, one of each person first.",
        "`replay` returns walks of strangers as they are: what a model has to reach. Strangers "
        "differ more from each other than walks of a person do, so that variance ratios are large.",
        "In tasks of one person, mirror images, a trend drawn for each sample, a common clock and "
        "random postures did not bring samples above `replay` in both MCC and MLC.",
    ),
)
