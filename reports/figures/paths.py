"""Commands of SVG paths: coordinates, and lines through points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["coordinate", "outline", "segments"]


def coordinate(value: float) -> str:
    """Return a coordinate with at most one decimal."""
    return f"{value:z.1f}".removesuffix(".0")


def segments(xs: Array, ys: Array) -> str:
    """Return the commands of a line through points, each relative to the last one."""
    gaps = np.flatnonzero(np.isnan(xs) | np.isnan(ys))
    runs = np.split(np.stack([xs, ys], axis=1), gaps)
    whole = (run[~np.isnan(run).any(axis=1)] for run in runs)
    return "".join(outline(run) for run in whole if len(run))


def outline(points: Array) -> str:
    """Return a line through points in tenths of a pixel, which add up without rounding error."""
    tenths = np.rint(points * 10.0).astype(int)
    steps = np.diff(tenths, axis=0)
    first = " ".join(coordinate(value / 10) for value in tenths[0])
    return f"M{first}" + ("l" if len(steps) else "") + _join_numbers(steps.ravel().tolist())


def _join_numbers(tenths: Sequence[int]) -> str:
    """Return numbers side by side, separated only where they would run into each other."""
    first, *others = [_tenths(value) for value in tenths] or [""]
    return first + "".join(n if n.startswith("-") else f" {n}" for n in others)


def _tenths(value: int) -> str:
    """Return a number of tenths, without the zero before its point."""
    return f"{value / 10:g}".replace("0.", ".") if abs(value) < 10 else f"{value / 10:g}"
