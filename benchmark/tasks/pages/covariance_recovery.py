"""The page of the recovery of covariances."""

from __future__ import annotations

from mocapbench.benchmark.figures.covariances import draw_covariances
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Recovery of the generating covariances",
    short="Layers",
    reference="thesis §5.2.3, Figures 11–13",
    description=(
        "Five complete children of one parent come from a process whose outputs correlate strongly "
        "(coregionalisation factors between 0 and 1). The fitted covariance of the children around "
        "their parent, K_f, and that of the parent, K_g, both without noise, are compared with the "
        "true ones. Every fold draws a new process."
    ),
    kind="recover",
    question="recover",
    metrics=("frobenius_child", "frobenius_parent", "logdet_child", "logdet_parent"),
    remarks=(
        "The thesis shows these covariances as pictures of one dataset and gives no numbers.",
        "A model with one kernel has no parent: its kernel is set beside K_f, as in Figure 11 of "
        "the thesis. For pooled or independent recordings, K_g or K_f + K_g would be as fair a "
        "match.",
        "One parent was drawn, so that an estimate of K_g is poor however well a model is trained.",
    ),
    illustrated=("correlated outputs",),
    figures=(draw_covariances,),
)
