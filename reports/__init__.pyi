from .bundle.bundle import Bundle, CaseLayout, MetricInfo, TaskLayout
from .bundle.pictures import (
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
from .bundle.regression_check import RegressionCheck
from .page.page import render

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
