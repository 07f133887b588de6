"""A results bundle in; tables, figures and one offline HTML page out."""

from mocapbench.reports.bundle import Bundle, CaseLayout, MetricInfo, TaskLayout
from mocapbench.reports.checks import RegressionCheck
from mocapbench.reports.illustration import (
    Band,
    Curve,
    HeatMap,
    HeatMaps,
    Illustration,
    Panel,
    Path3D,
    Picture,
    Space,
)
from mocapbench.reports.page import render

__all__ = [
    "Band",
    "Bundle",
    "CaseLayout",
    "Curve",
    "HeatMap",
    "HeatMaps",
    "Illustration",
    "MetricInfo",
    "Panel",
    "Path3D",
    "Picture",
    "RegressionCheck",
    "Space",
    "TaskLayout",
    "render",
]
