from .bundle.bundle import Bundle
from .bundle.error_parts import ErrorParts
from .bundle.layout import CaseLayout, TaskLayout
from .bundle.metric_info import MetricInfo
from .bundle.model_info import ModelInfo
from .bundle.origin import Origin
from .bundle.pictures import Axes, Curve, HeatMaps, Illustration, Motions, Picture, Space
from .bundle.task_page import Figure, TaskPage
from .export.latex import figure_latex
from .export.selection import select_results
from .export.typesetting import latex_text, markdown_text, paper_tables
from .figures.plots.along_column import AlongColumn
from .figures.plots.base import NothingToDrawError, Plot
from .figures.plots.drawing import FIGURE_FORMATS, render_figure
from .figures.plots.kinds import FIGURE_KINDS
from .figures.plots.look import LOOKS
from .figures.plots.on_axes import draw_on_axes
from .figures.plots.run_figures import describe_figure, tabulate_figures
from .figures.styles import DrawingStyle, model_styles
from .filling.curves import FilledCurve
from .filling.page import FilledPage, render_filled
from .page.leaderboard import render_leaderboard
from .page.report import render
from .run_comparison.render import render_changes
from .run_comparison.values import Change, ChangeVerdict, RunChanges, ScoreChange
from .spreadsheet import csv_text
from .tables.base import Table
from .workbook import xlsx_bytes

__all__ = [
    "FIGURE_FORMATS",
    "FIGURE_KINDS",
    "LOOKS",
    "AlongColumn",
    "Axes",
    "Bundle",
    "CaseLayout",
    "Change",
    "ChangeVerdict",
    "Curve",
    "DrawingStyle",
    "ErrorParts",
    "Figure",
    "FilledCurve",
    "FilledPage",
    "HeatMaps",
    "Illustration",
    "MetricInfo",
    "ModelInfo",
    "Motions",
    "NothingToDrawError",
    "Origin",
    "Picture",
    "Plot",
    "RunChanges",
    "ScoreChange",
    "Space",
    "Table",
    "TaskLayout",
    "TaskPage",
    "csv_text",
    "describe_figure",
    "draw_on_axes",
    "figure_latex",
    "latex_text",
    "markdown_text",
    "model_styles",
    "paper_tables",
    "render",
    "render_changes",
    "render_figure",
    "render_filled",
    "render_leaderboard",
    "select_results",
    "tabulate_figures",
    "xlsx_bytes",
]
