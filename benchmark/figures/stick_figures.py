"""A motion as stick figures in a row."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.body import Body
from mocapbench.datasets import Recording, Skeleton
from mocapbench.reports import Axes, Curve

__all__ = ["strip"]

N_FIGURES = 8
STRIDE = 90.0
"""Centimetres from one stick figure to the next."""


def strip(motion: Recording, body: Body, groups: Sequence[str], title: str = "") -> Axes:
    """Return stick figures at even times, seen from the side and set apart.

    Parameters
    ----------
    motion : Recording
        Two frames (N) or more, of which at most eight are shown.
    body : Body
    groups : sequence of str
        In which style to draw each frame (N).
    title : str
        What the heading begins with.
    """
    n_figures = min(N_FIGURES, len(motion.times))
    frames = np.linspace(0, len(motion.times) - 1, n_figures).round().astype(int)
    places = body.positions(motion)[frames]
    places = places - places[:, :1] * [0.0, 0.0, 1.0]
    places[..., 1] -= places[..., 1].min(axis=1, keepdims=True)
    places[..., 2] += STRIDE * np.arange(n_figures)[:, None]
    return Axes(
        f"{title}every {np.diff(motion.times[frames]).mean():.2g} s",
        "cm, set apart",
        "height, cm",
        tuple(
            _sticks(body.skeleton, figure, groups[frame])
            for figure, frame in zip(places, frames, strict=True)
        ),
        spatial=True,
    )


def _sticks(skeleton: Skeleton, joints: NDArray[np.float64], group: str) -> Curve:
    """Return the bones between joints (J, 3) as one broken line."""
    ends = joints[1:]
    starts = joints[list(skeleton.parents[1:])]
    line = np.stack([starts, ends, np.full_like(ends, np.nan)], axis=1).reshape(-1, 3)
    return Curve(line[:, 2], line[:, 1], group)
