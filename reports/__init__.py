"""A results bundle in; tables, figures and one offline HTML page out."""

from mocapbench.reports.bundle import Bundle, CaseLayout, MetricInfo, TaskLayout
from mocapbench.reports.page import render

__all__ = ["Bundle", "CaseLayout", "MetricInfo", "TaskLayout", "render"]
