"""The page of the similarity of real recordings."""

from __future__ import annotations

from mocapbench.benchmark.tasks.thesis_recordings import KICKS, WALKS
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

_PAIRS = [f"{row} vs {column}" for row in WALKS for column in (*WALKS, *KICKS)]

PAGE = TaskPage(
    title="Similarity of real recordings",
    reference="thesis §A.4.2, Tables 18–21",
    description=(
        "Each walk that samples are compared with is itself compared with every such walk and with "
        "every soccer kick: this is how similar real motions are. MCC of a recording with itself "
        "is what a sample could reach."
    ),
    kind="synthesise",
    question="recover",
    metrics=("mcc", "mlc"),
    published_rows={pair: pair for pair in _PAIRS},
    published_models={"replay": "real"},
    published_metrics={"mcc": "MCC", "mlc": "MLC"},
    crossed=("recording", "reference"),
)
