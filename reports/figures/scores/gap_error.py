"""The error along the gap, over the gaps of all windows."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from markupsafe import Markup

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.figures.axes import LEFT, TOP, WIDTH, draw_axes, panels
from mocapbench.reports.figures.marks import band, group, polyline
from mocapbench.reports.figures.scale import fit_linear_scale
from mocapbench.reports.figures.scores.best import CHOICE, best_labels
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure, line_keys

__all__ = ["N_BEST", "errors_along_gaps", "gap_error"]

HEIGHT, N_BEST = 220.0, 5


def gap_error(
    results: TaskResults, parts: ErrorParts, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return the mean error along gaps of the best models; None where no gap is long enough."""
    metric = parts.metrics.get(results.layout.name, "")
    windows = errors_along_gaps(results, parts)
    labels = best_labels(results, metric, windows, N_BEST) if windows else []
    if not labels:
        return None
    title = results.metrics[metric].title
    n = format_count(max(len(windows[label]) for label in labels), "gap")
    banded = list(dict.fromkeys([labels[0], labels[-1]]))
    caption = (
        f"mean over {n} of all windows and cases with recordings, each stretched to one length, of "
        f"{CHOICE}. Shaded areas hold the middle half of the gaps, of "
        f"{' and '.join(banded)}."
    )
    drawn = _axes({label: windows[label] for label in labels}, title, banded, styles)
    legend = line_keys({label: styles[label] for label in labels})
    return SvgFigure("Error along the gap", panels([drawn]), legend, caption)


def errors_along_gaps(results: TaskResults, parts: ErrorParts) -> dict[str, Array]:
    """Return the errors (W, P) of each label at P places along W gaps of representative cases."""
    metric = parts.metrics.get(results.layout.name, "")
    if not metric:
        return {}
    cases = {case.name for case in results.representative_cases(metric)}
    found: dict[str, list[Array]] = {}
    for (task, case, label), errors in parts.along_gap.items():
        if task == results.layout.name and case in cases:
            found.setdefault(label, []).append(errors.astype(np.float64))
    return {label: np.concatenate(errors) for label, errors in found.items()}


def _axes(
    windows: Mapping[str, Array], title: str, banded: list[str], styles: Mapping[str, DrawingStyle]
) -> Markup:
    n_places = next(iter(windows.values())).shape[1]
    places = (np.arange(n_places) + 0.5) / n_places
    means = {label: errors.mean(axis=0) for label, errors in windows.items()}
    bands = {label: np.quantile(windows[label], [0.25, 0.75], axis=0) for label in banded}
    x = fit_linear_scale([0.0, 1.0], LEFT, WIDTH)
    y = fit_linear_scale(
        np.concatenate([[0.0], *means.values(), *map(np.ravel, bands.values())]), 0.0, 1.0
    )
    y = type(y)(0.0, y.high, TOP + HEIGHT, TOP)
    at = x.places(places)
    marks = [
        *(group(styles[n], band(at, *y.places(sides))) for n, sides in bands.items()),
        *(group(styles[n], polyline(at, y.places(m)), title=n) for n, m in means.items()),
    ]
    names = "from the first hidden frame to the last", title
    label = f"{title} along the gap, of {format_count(len(windows), 'model')}"
    return draw_axes((x, y), "", names, marks, label)
