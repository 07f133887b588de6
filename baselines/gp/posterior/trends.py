"""The trend that new recordings are drawn around, once a model is fitted.

The thesis (§5.2) infers it and takes it for known; new recordings then resemble each other, and the
recordings fitted, a little more than they should. A draw from its posterior makes a set of new
recordings an exact draw of further replicates, given all that is visible.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from mocapbench.baselines.gp.posterior.fitted import FittedProcess
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["TRENDS", "Trend"]

Trend = Callable[[FittedProcess, Frames, np.random.Generator], FrameByChannel]
"""Gives the trend of a fitted process at times (M,), (M, D), in the outputs' own units."""


def _mean(process: FittedProcess, times: Frames, rng: np.random.Generator) -> FrameByChannel:
    del rng  # nothing is drawn
    ((mean, _),) = process.infer([process.reduction.trend], [times])
    return mean


def _posterior(process: FittedProcess, times: Frames, rng: np.random.Generator) -> FrameByChannel:
    (trend,) = process.draw(process.reduction.trend, times, 1, rng)
    return np.asarray(trend)


TRENDS: Mapping[str, Trend] = MappingProxyType({"mean": _mean, "posterior": _posterior})
"""The trends by the name that models take: its posterior mean, or a draw from its posterior."""
