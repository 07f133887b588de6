"""The page of hidden markers."""

from __future__ import annotations

from mocapbench.benchmark.figures.longest_gaps import draw_longest_gaps
from mocapbench.datasets.occlusion.fixed_masks import published_errors
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]


PAGE = TaskPage(
    title="Marker masks",
    reference="Kieu 2022",
    description=(
        "Real markers are hidden in 400 frames of a recording, and other stretches of it learnt "
        "from. The 150 masks of a paper hide 3, 6 or 9 markers of 41 for three seconds each, in "
        "the recording 135_02; masks alike are drawn for 85_02. Gaps besides are as long, as many "
        "and as coincident as in files of laboratories."
    ),
    question="other-channels",
    metrics=("mae", "coverage_95", "crps", "msll"),
    published_rows={f"{n} markers": f"{n} markers" for n in (3, 6, 9)},
    published_metrics={"mae": "mean absolute error"},
    published_folds={f"{n} markers": published_errors(n) for n in (3, 6, 9)},
    illustrated=("9 markers", "synthetic 3 markers"),
    figures=(draw_longest_gaps,),
    remarks=(
        "The paper’s method had frames 250 to 649 as a reference. Of these, 200 are tested, so "
        "that it was shown part of the truth.",
        "Models here learn from frames 450 to 849, 1050 to 1449 and 1450 to 1849, and from what is "
        "visible.",
        "A published value is the mean of 50 errors that the authors’ repository prints, one for "
        "each mask.",
        "All masks of a case are on one recording of one person, who is the unit of statistics: no "
        "lead is tested, however many masks show it.",
        "Lengths of real gaps, and how many overlap, are those of two files, of a reach by Vicon "
        "and a walk by OptiTrack. Which markers are hidden, and when, is drawn.",
    ),
)
