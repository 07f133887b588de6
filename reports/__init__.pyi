from .bundle.bundle import Bundle
from .bundle.error_parts import ErrorParts
from .bundle.layout import CaseLayout, TaskLayout
from .bundle.metric_info import MetricInfo
from .bundle.model_info import ModelInfo
from .bundle.origin import Origin
from .bundle.pictures import Axes, Curve, HeatMaps, Illustration, Motions, Picture, Space
from .bundle.regression_check import RegressionCheck
from .bundle.task_page import Figure, RowNotes, TaskPage
from .filling.curves import FilledCurve
from .filling.page import FilledPage, render_filled
from .page.page import render
from .slopes.page import render_changes
from .slopes.values import (
    ChangedFact,
    ChangedParameter,
    ChangeVerdict,
    ComparedTask,
    Ending,
    RunChanges,
    ScoreChange,
    Unpaired,
)
from .spreadsheet import csv_text

__all__ = [
    "Axes",
    "Bundle",
    "CaseLayout",
    "ChangeVerdict",
    "ChangedFact",
    "ChangedParameter",
    "ComparedTask",
    "Curve",
    "Ending",
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
    "RegressionCheck",
    "RowNotes",
    "RunChanges",
    "ScoreChange",
    "Space",
    "TaskLayout",
    "TaskPage",
    "Unpaired",
    "csv_text",
    "render",
    "render_changes",
    "render_filled",
]
