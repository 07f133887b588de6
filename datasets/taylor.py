"""The 59 values of Taylor, Hinton and Roweis's experiment with missing data, and its scales.

- G. W. Taylor, G. E. Hinton and S. T. Roweis, *Modeling Human Motion Using Binary Latent
  Variables*, NIPS 19, 2006.
- N. D. Lawrence, *Learning for Larger Datasets with the Gaussian Process Latent Variable Model*,
  AISTATS, 2007.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["taylor_deviations", "taylor_features", "taylor_scales"]

_STEP = 4  # from 120 to the papers' 30 frames per second


def taylor_features(recording: Recording) -> Recording:
    """Return the 59 values of Taylor et al. at every 4th frame after the first.

    They are 50 joint angles a (no clavicles, no fingers) as arcsin(sin a), in radians; the root's
    x and z as differences, and its y; sin and cos of the root's rx and rz; and the differences of
    sin and cos of its ry. A difference is that from the frame kept before, so that the first frame
    serves for differences only. Each value is divided by its `taylor_deviations`.

    Parameters
    ----------
    recording : Recording
        N frames of the 62 channels of the CMU database, at 120 frames per second.

    Returns
    -------
    Recording
        ⌈N / 4⌉ − 1 frames of 59 channels, at 30 frames per second. The unit of all is ``"sd"``.

    Raises
    ------
    ValueError
        If a channel is missing, or the recording has fewer than five frames.

    References
    ----------
    Taylor, Hinton and Roweis (2006); Lawrence (2007).

    Examples
    --------
    >>> from mocapbench.datasets import open_archive, taylor_features
    >>> walk = open_archive().recording("gait:01_01")
    >>> walk.values.shape, taylor_features(walk).values.shape
    ((331, 62), (82, 59))
    """
    deviations = taylor_deviations()
    if len(recording.times) <= _STEP:
        raise ValueError(
            f"recording {recording.name!r}: expected five frames or more, of which every 4th is "
            f"kept and the first serves for differences, got {len(recording.times)}"
        )
    kept = recording.frames(np.arange(0, len(recording.times), _STEP))
    values = np.column_stack([*_angles(kept), *_root(kept)])[1:] / [*deviations.values()]
    return replace(
        kept,
        times=kept.times[1:],
        values=values,
        channels=tuple(deviations),
        units=("sd",) * len(deviations),
    )


@cache
def taylor_deviations() -> Mapping[str, float]:
    """Return the standard deviation of each of the 59 values, by channel.

    It is that (ddof 1) over the 2,613 frames of the experiment's 31 training recordings, in radians
    for joint angles and in the skeleton's unit of length for the root's path.
    """
    return MappingProxyType({row["channel"]: float(row["deviation"]) for row in _table()})


@cache
def taylor_scales() -> Mapping[str, float]:
    """Return Taylor's scale of each of the 50 joint angles, in 1/degree, by channel.

    The experiment's *cumulative scaled error* multiplies errors in degrees by them. They are near
    the reciprocals of the angles' standard deviations.
    """
    return MappingProxyType(
        {row["channel"]: float(row["scale"]) for row in _table() if row["scale"]}
    )


def _table() -> list[dict[str, str]]:
    with Path(__file__).with_name("taylor.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def _angles(kept: Recording) -> Iterator[Frames]:
    """Yield arcsin(sin a) of the joint angles, which have scales, in the order of the channels."""
    for angle in _radians(kept, [*taylor_scales()]).T:
        yield np.arcsin(np.sin(angle))


def _root(kept: Recording) -> Iterator[Frames]:
    """Yield the nine values of the root, in the order of the channels."""
    x, y, z = kept.select(["root.tx", "root.ty", "root.tz"]).values.T
    pitch, heading, roll = _radians(kept, ["root.rx", "root.ry", "root.rz"]).T
    yield from (_steps(x), y, _steps(z))
    yield from (np.sin(pitch), np.cos(pitch), np.sin(roll), np.cos(roll))
    yield from (_steps(np.sin(heading)), _steps(np.cos(heading)))


def _radians(kept: Recording, channels: list[str]) -> FrameByChannel:
    return np.deg2rad(kept.select(channels).values)


def _steps(values: Frames) -> Frames:
    """Return the differences from the frame before; the first frame's has no meaning."""
    return np.diff(values, prepend=np.nan)
