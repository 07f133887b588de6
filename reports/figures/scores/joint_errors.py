"""The error by joint on a body, one body a model."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from markupsafe import Markup

from mocapbench.basics.arrays import Array
from mocapbench.metrics.entries import mean_over
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.figures.axes import panels
from mocapbench.reports.figures.marks import disc, group, polyline, svg, text
from mocapbench.reports.figures.scores.best import CHOICE, best_labels
from mocapbench.reports.figures.styles import TRUTH, DrawingStyle
from mocapbench.reports.figures.svg_figure import Key, SvgFigure, key

__all__ = ["joint_errors"]

WIDTH, HEIGHT, TOP, EDGE = 230.0, 240.0, 36.0, 16.0
N_BEST, LARGEST = 3, 13.0
"""How many models, and the radius of the largest error, in pixels."""
METRIC = "mpjpe"


def joint_errors(
    results: TaskResults, parts: ErrorParts, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return bodies from the front with a disc on each joint; None without a body or errors."""
    pose = parts.rest_poses.get(results.layout.name)
    errors = _errors(results, parts)
    labels = best_labels(results, METRIC, errors, N_BEST) if errors else []
    if pose is None or not labels:
        return None
    largest = max(float(np.nanmax(errors[label])) for label in labels)
    drawn = [_body(pose, errors[label], largest, styles[label]) for label in labels]
    caption = (
        "the area of a disc is the mean position error of the joint relative to the root, over "
        "folds and cases with recordings; joints that are never hidden have none. The body is "
        f"seen from the front, at rest; shown are {CHOICE}."
    )
    return SvgFigure("Error by joint", panels(drawn), _legend(largest), caption)


def _errors(results: TaskResults, parts: ErrorParts) -> dict[str, Array]:
    """Return the errors (J,) of each label, mean over the representative cases."""
    if METRIC not in results.metrics:
        return {}
    cases = {case.name for case in results.representative_cases(METRIC)}
    found: dict[str, list[Array]] = {}
    for (task, case, label), errors in parts.by_joint.items():
        if task == results.layout.name and case in cases:
            found.setdefault(label, []).append(errors.astype(np.float64))
    stacked = {label: np.stack(of_cases) for label, of_cases in found.items()}
    return {label: mean_over(them, np.isfinite(them), axis=0) for label, them in stacked.items()}


def _body(pose: pd.DataFrame, errors: Array, largest: float, style: DrawingStyle) -> Markup:
    places = _place_joints(pose)
    bones = [(joint, parent) for joint, parent in enumerate(pose["parent"]) if parent >= 0]
    gap = np.full(2, np.nan)
    line = np.array([row for j, p in bones for row in (places[j], places[p], gap)])
    discs = [
        disc(x, y, LARGEST * np.sqrt(error / largest), f"{name}: {error:.1f} cm")
        for (x, y), name, error in zip(places, pose.index, errors, strict=True)
        if np.isfinite(error)
    ]
    worst = int(np.nanargmax(errors))
    summary = f"{np.nanmean(errors):.2g} cm on average, {errors[worst]:.2g} at {pose.index[worst]}"
    marks = [
        text(0.0, 13.0, style.label, "title"),
        text(0.0, 27.0, summary),
        polyline(line[:, 0], line[:, 1], "bone"),
        group(style, *discs),
    ]
    return svg(WIDTH, HEIGHT, f"{style.label}: position error by joint, {summary}", marks)


def _place_joints(pose: pd.DataFrame) -> Array:
    """Return where the joints are in the panel, seen from the front: the left is on the right."""
    seen = pose[["x", "y"]].to_numpy() * [1.0, -1.0]
    low, high = seen.min(axis=0), seen.max(axis=0)
    room = np.array([WIDTH - 2.0 * EDGE, HEIGHT - TOP - 2.0 * EDGE])
    unit = float((room / np.maximum(high - low, 1e-9)).min())
    middle = np.array([WIDTH / 2.0, TOP + (HEIGHT - TOP) / 2.0])
    return np.asarray(middle + (seen - (low + high) / 2.0) * unit)


def _legend(largest: float) -> tuple[Key, ...]:
    """Return discs of a quarter of the largest error and of a sixteenth, in area."""
    shares = {f"{largest * share:.2g} cm": share for share in (1 / 4, 1 / 16)}
    return tuple(
        key(name, TRUTH, disc(14.0, 7.0, LARGEST * np.sqrt(share)))
        for name, share in shares.items()
    )
