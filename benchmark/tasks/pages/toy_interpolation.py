"""The pages of interpolation on toy data."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.filled_channels import draw_filled_channels
from mocapbench.benchmark.figures.trend import draw_trends
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["MUCH_NOISE_PAGE", "ONE_INCOMPLETE_PAGE", "TOO_FEW_COMPONENTS_PAGE"]

_METRICS = ("smse_pooled", "mse", "msll", "smse")
_PUBLISHED_METRICS = {"mse": "MSE", "smse_pooled": "SMSE", "msll": "MSLL"}
_FIGURES = (
    partial(draw_filled_channels, channels=("output-1",)),
    partial(draw_trends, channels=("output-1",)),
)
_REMARKS = (
    "The thesis used one dataset per test and does not disclose the variances of its layers. Here "
    "every fold draws a new dataset, so that ± describes the protocol and not one draw.",
)
_ASSUMED = (
    "The thesis does not say how many outputs and children these tests had; three and ten are "
    "assumed."
)
_BELOW_THE_NOISE = (
    "Table 7 has mean squared errors of .078 and .095 where the noise alone has a variance of .1, "
    "so Tables 7–9 were not scored against noisy observations, as ours are"
)


def _rows(n_tests: int) -> dict[str, str]:
    return {f"test {n}": f"test {n}" for n in range(1, n_tests + 1)}


ONE_INCOMPLETE_PAGE = TaskPage(
    title="Toy interpolation, one incomplete child",
    short="Toy 1",
    reference="thesis §5.1.1, Tables 1–3, Figure 17",
    description=(
        "Children of one parent are drawn from a two-layer LMC Gaussian process with three "
        "components a layer. All are complete but the last, of which 5 of 50 points per output "
        "are visible; the rest is to be filled. Every fold draws a new process, new children and "
        "a new mask."
    ),
    question="scattered-samples",
    metrics=_METRICS,
    published_rows=_rows(9),
    published_models={"mohgp-3": "MOHGP", "moa-3": "MOA"},
    published_metrics=_PUBLISHED_METRICS,
    remarks=_REMARKS,
    illustrated=("test 1",),
    figures=_FIGURES,
)

TOO_FEW_COMPONENTS_PAGE = TaskPage(
    title="Toy interpolation, one component against three",
    short="Toy 2",
    reference="thesis §5.1.1, Tables 4–6, Figure 18",
    description=(
        "Data as in the first experiment, three outputs and ten children, of which all or only "
        "the last are incomplete: 5 of 50 points per output are visible. The hierarchical model "
        "has one component a layer where the process has three; the reference model has three and "
        "is trained from five starts."
    ),
    question="scattered-samples",
    metrics=_METRICS,
    published_rows=_rows(6),
    published_models={"mohgp-1": "MOHGP", "moa-3": "MOA"},
    published_metrics=_PUBLISHED_METRICS,
    remarks=(*_REMARKS, _ASSUMED),
    illustrated=("test 4",),
    figures=_FIGURES,
)

MUCH_NOISE_PAGE = TaskPage(
    title="Toy interpolation under much noise",
    short="Toy 3",
    reference="thesis §5.1.1, Tables 7–9, Figure 19",
    description=(
        "Data from one component a layer with noise of variance .1, three outputs and ten "
        "children, of which all or only the last are incomplete: 10 or 20 of 50 points per output "
        "are visible. The hierarchical model has one component a layer, as the process has; the "
        "reference model has three and is trained from ten starts."
    ),
    question="scattered-samples",
    metrics=_METRICS,
    published_rows=_rows(4),
    published_models={"mohgp-1": "MOHGP", "moa-3": "MOA"},
    published_metrics=_PUBLISHED_METRICS,
    not_comparable=dict.fromkeys([("mohgp-1", "*"), ("moa-3", "*")], _BELOW_THE_NOISE),
    remarks=(*_REMARKS, _ASSUMED),
    illustrated=("test 2",),
    figures=_FIGURES,
)
