"""Every kind of picture that a report draws, as plain values.

The harness decides which pictures to show; `mocapbench.reports.figures` draws them.
"""

from __future__ import annotations

from mocapbench.reports.bundle.heat_maps import HeatMap, HeatMaps
from mocapbench.reports.bundle.motions import Motion, Motions
from mocapbench.reports.bundle.panels import Band, Curve, Illustration, Panel
from mocapbench.reports.bundle.spaces import Path3D, Space

__all__ = [
    "Band",
    "Curve",
    "HeatMap",
    "HeatMaps",
    "Illustration",
    "Motion",
    "Motions",
    "Panel",
    "Path3D",
    "Picture",
    "Space",
]

Picture = Illustration | HeatMaps | Space | Motions
"""A figure of one task, of any kind."""
