"""The page of style clustering."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.alignment import draw_alignments
from mocapbench.benchmark.figures.blends import draw_blends
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

_NUMBERS = (4, 1, 2, 3, 5, 6, 7, 8)

PAGE = TaskPage(
    title="Style clustering",
    short="Walk styles",
    reference="HLM §4.1, Figures 1 and 2",
    description=(
        "Recordings of walks, slow walks, strides and runs, at 30 Hz and without labels, are to be "
        "grouped into C clusters, which are then compared with the labels. A fold is a restart: "
        "the recordings are the same, the model's random start is another."
    ),
    kind="cluster",
    question="find-styles",
    metrics=("purity", "adjusted_rand"),
    remarks=(
        "Intervals are over restarts on the same recordings: they show how much a start matters, "
        "not how other recordings would be clustered.",
    ),
    illustrated=(
        "C = 4",
        "synthetic C = 4",
        *(f"C = {n}" for n in _NUMBERS[1:]),
        *(f"synthetic C = {n}" for n in _NUMBERS[1:]),
    ),
    figures=(draw_alignments, partial(draw_blends, channels=("lfemur.rx", "ltibia.rx"))),
)
