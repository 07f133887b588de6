"""The page of the recovery of covariances."""

from __future__ import annotations

from mocapbench.benchmark.figures.covariances import RecoveredCovariances
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Recovery of the generating covariances",
    short="Covariance recovery",
    reference="thesis §5.2.3, Figures 11–13",
    description=(
        "Five complete children of one parent are drawn from a process whose outputs correlate "
        "strongly: the factors of its coregionalisation matrices lie between 0 and 1. The "
        "covariance of the children around their parent, K_f, without noise, and the parent's, "
        "K_g, of the fitted models are compared with the true ones. Every fold draws a new process."
    ),
    kind="recover",
    question="recover",
    metrics=("frobenius_child", "frobenius_parent", "logdet_child", "logdet_parent"),
    remarks=(
        "The thesis shows these covariances as pictures of one dataset and gives no numbers.",
        "A model with one kernel has no parent. Its kernel is set beside K_f, as in Figure 11 of "
        "the thesis. For the pooled model, whose one function all children share, and for "
        "independent draws, which carry the parent's variance too, K_g or K_f + K_g would be as "
        "fair a match.",
        "One parent was drawn, so that its covariance is known from a single draw: an estimate of "
        "K_g is poor however well a model is trained.",
    ),
    illustrated=("correlated outputs",),
    figures=(RecoveredCovariances(),),
)
