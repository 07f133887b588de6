"""Whether a metric is a directed, pure, finite function of its outcome."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mocapbench.benchmark.score_values import fault_of_score
from mocapbench.benchmark.testing.errors import ConformanceError, raised_by, require
from mocapbench.benchmark.testing.subject import COMPLETE, GAP, TIMES
from mocapbench.metrics import (
    Clustering,
    Imputation,
    ImputedPoses,
    Metric,
    Recovery,
    SampledPoses,
    Synthesis,
)
from mocapbench.metrics.in_betweening import QUATERNION

__all__ = ["check_metric"]

_JOINTS = ("root", "foot")


def _imputed_poses() -> ImputedPoses:
    """Return a foot that stands and is filled a little off, below a root that moves."""
    n_frames = len(TIMES)
    truth = np.zeros((n_frames, 2, 3))
    truth[:, 0] = [0.0, 1.0, 0.0]
    truth[:, 0, 2] = np.sin(TIMES)
    gap = np.outer(GAP.any(axis=1), [False, True])
    mean = truth + 0.1 * gap[..., None] * np.cos(9.0 * TIMES)[:, None, None]
    spread = np.ones((2, 3))
    return ImputedPoses(truth, mean, gap, gap, _JOINTS, (-1, 0), TIMES, spread=spread)


def _sampled_poses() -> SampledPoses:
    """Return two samples and two references of a foot that moves below a root at rest."""
    paths = np.zeros((4, len(TIMES), 2, 3))
    paths[:, :, 0, 1] = 1.0
    paths[:, :, 1, 2] = np.sin(np.outer(np.arange(1.0, 5.0), TIMES))
    return SampledPoses(paths[:2], paths[2:], _JOINTS, TIMES)


_IMPUTED = Imputation(
    truth=COMPLETE[0].values,
    mean=COMPLETE[0].values + 0.1,
    variance=np.full((20, 2), 0.5),
    hidden=GAP,
    visible_mean=np.zeros(2),
    visible_variance=np.ones(2),
    scales=np.ones(2),
    units=("deg", ""),
    place_joints=_imputed_poses,
)
_N_CONTINUED = 2 * len(TIMES)


def _continued_poses() -> ImputedPoses:
    """Return a foot of which only the first frames are visible."""
    truth = np.zeros((_N_CONTINUED, 2, 3))
    hidden = np.outer(np.arange(_N_CONTINUED) > 4, [False, True])
    times = np.arange(_N_CONTINUED) / 60
    return ImputedPoses(
        truth, truth + 0.1 * hidden[..., None], hidden, hidden, _JOINTS, (-1, 0), times
    )


_CONTINUED = replace(
    _IMPUTED,
    truth=np.tile(_IMPUTED.truth, (2, 1)),
    mean=np.tile(_IMPUTED.mean, (2, 1)),
    variance=None,
    hidden=np.repeat((np.arange(_N_CONTINUED) > 4)[:, None], 2, axis=1),
    place_joints=_continued_poses,
)
OUTCOMES: Mapping[type, tuple[Any, ...]] = {
    Imputation: (
        *(
            replace(_IMPUTED, units=units)
            for units in (("deg", ""), ("cm",) * 2, (QUATERNION,) * 2)
        ),
        _CONTINUED,
    ),
    Synthesis: (
        Synthesis(
            np.stack([r.values for r in COMPLETE[:2]]),
            np.stack([r.values for r in COMPLETE[2:]]),
            _sampled_poses,
        ),
    ),
    Recovery: (
        Recovery(
            truth={"parent": 2.0 * np.eye(3), "child": np.eye(3)},
            estimate={"parent": np.eye(3), "child": 0.5 + np.eye(3)},
            noise=0.1,
        ),
    ),
    Clustering: (Clustering(np.array(["walk", "walk", "run"]), np.array([0, 1, 1])),),
}
"""Small outcomes of each kind, of which every metric should be defined for one."""


def check_metric(metric: Metric[Any]) -> None:
    """Check that a metric is a directed, pure, finite function of its outcome.

    Raises
    ------
    ConformanceError
        At the first thing that is wrong.
    """
    advice = "declare the function with @metric(title=..., direction=...)"
    require(isinstance(metric, Metric), "a mocapbench.metrics.Metric", repr(metric), advice)
    with raised_by(f"metric {metric.name}", "it scores an outcome"):
        _check_declaration(metric)
        _check_values(metric)
    if metric.outcome is Imputation:
        with raised_by(f"metric {metric.name}", "it looks at hidden entries"):
            _check_hidden_only(metric)


def _check_declaration(metric: Metric[Any]) -> None:
    kinds = [kind.__name__ for kind in OUTCOMES]
    require(metric.outcome in OUTCOMES, f"an outcome among {kinds}", metric.outcome, "take one")
    documented = inspect.getdoc(metric.statistic)
    advice = "state formula, axis and ddof"
    require(documented, "a docstring of the statistic", documented, advice)


def _plain(metric: Metric[Any]) -> Any:
    """Return the first outcome that the metric is defined for."""
    defined = next(filter(metric.applies, OUTCOMES[metric.outcome]), None)
    advice = "let `defined` leave out only outcomes that lack what the metric needs"
    require(defined is not None, "a metric that is defined for a plain outcome", "none", advice)
    return defined


def _check_values(metric: Metric[Any]) -> None:
    outcome = _plain(metric)
    one, two = (metric(outcome) for _ in range(2))
    for score in (one, two):
        fault = fault_of_score(score)
        if fault:
            raise ConformanceError(f"expected it {fault}")
    advice = "leave degenerate outputs out"
    require(np.isfinite(one.value), "a finite value of a plain outcome", one.value, advice)
    advice = "draw nothing in a metric"
    require(one.value == two.value, f"{one.value} again", two.value, advice)


def _check_hidden_only(metric: Metric[Any]) -> None:
    outcome = _plain(metric)
    elsewhere = replace(
        outcome,
        truth=np.where(outcome.hidden, outcome.truth, 1e6),
        mean=np.where(outcome.hidden, outcome.mean, -1e6),
    )
    one, two = metric(outcome).value, metric(elsewhere).value
    expected = f"{one} whatever the visible entries are"
    require(one == two, expected, two, "select outcome.hidden before you average")
