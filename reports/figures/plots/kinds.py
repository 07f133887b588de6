"""The kinds of figures for papers, by name."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.figures.plots.along_column import AlongColumn
from mocapbench.reports.figures.plots.along_gap import AlongGap
from mocapbench.reports.figures.plots.base import Plot
from mocapbench.reports.figures.plots.by_case import ByCase
from mocapbench.reports.figures.plots.calibration import Calibration
from mocapbench.reports.figures.plots.cost_against_error import Cost
from mocapbench.reports.figures.plots.covariances import Covariances
from mocapbench.reports.figures.plots.error_bars import ErrorBars
from mocapbench.reports.figures.plots.motion import StickFigures
from mocapbench.reports.figures.plots.rank_diagram import Ranks

__all__ = ["FIGURE_KINDS"]

FIGURE_KINDS: Mapping[str, Plot] = {
    "error-bars": ErrorBars(),
    "by-case": ByCase(),
    "along-gap": AlongGap(),
    "gap-length": AlongColumn("seconds", "length of the gap, s"),
    "recordings": AlongColumn("recordings", "training recordings"),
    "calibration": Calibration(),
    "ranks": Ranks(),
    "covariances": Covariances(),
    "stick-figures": StickFigures(),
    "cost": Cost(),
}
"""Kinds of figures for papers, by name."""
