"""A results bundle in; tables, figures and one offline HTML page out."""

from mocapbench.reports.bundle import Bundle, CaseLayout, MetricInfo, TaskLayout
from mocapbench.reports.checks import RegressionCheck
from mocapbench.reports.illustration import Curve, Illustration, Panel
from mocapbench.reports.page import render

__all__ = [
    "Bundle",
    "CaseLayout",
    "Curve",
    "Illustration",
    "MetricInfo",
    "Panel",
    "RegressionCheck",
    "TaskLayout",
    "render",
]
