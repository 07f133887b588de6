"""Errors along gaps and by joint: what a run found beneath its scores, small enough to draw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import pandas as pd
from numpy.typing import NDArray

__all__ = ["Cell", "ErrorParts"]

Array = NDArray[np.float32]
Cell = tuple[str, str, str]
"""Task, case and label."""


@dataclass(frozen=True, eq=False)
class ErrorParts:
    """Parts of errors by task, case and label.

    Parameters
    ----------
    metrics : mapping of str to str
        By task, the metric of ``along_gap``.
    along_gap : mapping of (task, case, label) to ndarray of shape (W, P)
        The error at P even places along each of W gaps that have visible frames at both ends.
    by_joint : mapping of (task, case, label) to ndarray of shape (J,)
        Position error relative to the root in centimetres, mean over folds; NaN where a joint is
        never hidden.
    rest_poses : mapping of str to DataFrame
        By task, the body whose J joints those are, at rest: a row for each joint, with the row of
        its ``parent``, negative for the root, and ``x``, ``y`` and ``z`` in centimetres; the y axis
        points up, and the body looks along z.
    """

    metrics: Mapping[str, str] = field(default_factory=dict)
    along_gap: Mapping[Cell, Array] = field(default_factory=dict)
    by_joint: Mapping[Cell, Array] = field(default_factory=dict)
    rest_poses: Mapping[str, pd.DataFrame] = field(default_factory=dict)
