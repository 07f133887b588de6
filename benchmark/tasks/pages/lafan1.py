"""The page of in-betweening on LaFAN1."""

from __future__ import annotations

from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]


PAGE = TaskPage(
    title="In-betweening on LaFAN1",
    reference="Harvey 2020, Oreshkin 2022, Qin 2022",
    description=(
        "Ten frames of a person and a target frame are seen, and the 5, 15, 30 or 45 between "
        "asked, in every window of subject 5. Models learn from subjects 1 to 4. Values are the "
        "root’s place and the rotation of each of 22 joints within its parent, as quaternions."
    ),
    short="LaFAN1",
    metrics=("l2q", "l2p", "npss_real_part", "mpjpe_global"),
    published_rows={f"{n} frames": f"{n} frames" for n in (5, 15, 30, 45)},
    published_models={"zero-velocity": "zero velocity"},
    published_metrics={"l2q": "L2Q", "l2p": "L2P", "npss_real_part": "NPSS"},
    illustrated=("30 frames", "synthetic 15 frames"),
    figures=(draw_filled_motion,),
    remarks=(
        "Nobody who made this task has run it on the real file. If zero-velocity does not have the "
        "published values there, the task is wrong: please say so.",
        "On a generated file of the same structure zero-velocity has the scores of the authors’ "
        "code to five digits.",
        "Windows of 65 frames begin every 40, so that they overlap, and all are of one person: "
        "there is one unit of statistics, and no test between models.",
        "L2P divides coordinates by standard deviations in windows of 50 frames, every 20, of "
        "subjects 1 to 4. Windows are centred on the floor and face one way at the tenth frame.",
        "NPSS is that of the public code, which squares the real part of the Fourier transform. "
        "The formula of its paper is the metric npss, beside which no published value stands.",
        "The published interpolation is spherical; models here fill number by number, and "
        "quaternions are divided by their length.",
    ),
)
