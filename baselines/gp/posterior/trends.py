"""The trend that new recordings are drawn around, once a model is fitted.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, §5.2, takes the trend's posterior mean as if it
were known. New recordings then resemble each other, and the fitted recordings, a little more than
they should. Drawn around a draw from the trend's posterior, a set of new recordings is an exact
draw of further replicates given all visible entries (docs/mathematics/prediction.md, section 9).
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
"""The trends by the name that models take: the posterior mean, or a draw from the posterior."""
