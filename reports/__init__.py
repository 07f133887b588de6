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
    Picture,
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
    "Picture",
    "RegressionCheck",
    "TaskLayout",
    "render",
]
