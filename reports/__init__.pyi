from .bundle.bundle import Bundle
from .bundle.error_parts import ErrorParts
from .bundle.layout import CaseLayout, TaskLayout
from .bundle.metric_info import MetricInfo
from .bundle.model_info import ModelInfo
from .bundle.origin import Origin
from .bundle.pictures import Axes, Curve, HeatMaps, Illustration, Motions, Picture, Space
from .bundle.task_page import Figure, TaskPage
from .export.typesetting import latex_text, markdown_text, paper_tables
from .filling.curves import FilledCurve
from .filling.page import FilledPage, render_filled
from .page.leaderboard import render_leaderboard
from .page.report import render
from .run_comparison.render import render_changes
from .run_comparison.values import Change, ChangeVerdict, RunChanges, ScoreChange
from .spreadsheet import csv_text
from .tables.base import Table

__all__ = [
    "Axes",
    "Bundle",
    "CaseLayout",
    "Change",
    "ChangeVerdict",
    "Curve",
    "ErrorParts",
    "Figure",
    "FilledCurve",
    "FilledPage",
    "HeatMaps",
    "Illustration",
    "MetricInfo",
    "ModelInfo",
    "Motions",
    "Origin",
    "Picture",
    "RunChanges",
    "ScoreChange",
    "Space",
    "Table",
    "TaskLayout",
    "TaskPage",
    "csv_text",
    "latex_text",
    "markdown_text",
    "paper_tables",
    "render",
    "render_changes",
    "render_filled",
    "render_leaderboard",
]
