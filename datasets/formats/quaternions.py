"""Quaternions: four numbers of length 1, of which q and −q are the same rotation.

A file may go from q to −q between two frames, as angles go from 180° to −180°. No model should see
that jump; and what is filled number by number is a rotation only after it has the length 1 again.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["align_quaternions", "find_quaternions", "finish_quaternions"]

_PART = re.compile(r"(.*?[._: -])?q(?:uat(?:ernion)?)?[._ -]?([wxyz]|[0-4])", re.IGNORECASE)
_PARTS = [set("wxyz"), set("0123"), set("1234")]
_TOLERANCE = 0.01
"""How far the length of most is from 1: four other numbers that have such names are left alone."""


def align_quaternions(values: FrameByChannel, channels: Sequence[str]) -> FrameByChannel:
    """Return values in which each quaternion is the nearer of q and −q to the one before.

    Parameters
    ----------
    values : ndarray of shape (N, D)
    channels : sequence of D str
        Four of which are called ``Hips.qw``, ``Hips.qx``, ``Hips.qy``, ``Hips.qz``, for instance.
    """
    result = values.copy()
    for places in find_quaternions(values, channels):
        result[:, places] *= _choose_signs(values[:, places])[:, np.newaxis]
    return result


def finish_quaternions(
    values: FrameByChannel, channels: Sequence[str], original: FrameByChannel, new: Mask
) -> FrameByChannel:
    """Return aligned values with quaternions of length 1 that continue those of a file.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        Values that continue ``align_quaternions(original)``.
    channels : sequence of D str
    original : ndarray of shape (N, D)
        What stays of the file, as it stands there.
    new : ndarray of bool of shape (N, D)
        The entries that are to be written; a quaternion of which some stay keeps its length.
    """
    result = values.copy()
    for places in find_quaternions(original, channels):
        lengths = np.linalg.norm(values[:, places], axis=1)
        whole = new[:, places].all(axis=1) & (lengths > 0)
        scales = _choose_signs(original[:, places]) / np.where(whole, lengths, 1.0)
        result[:, places] *= scales[:, np.newaxis]
    return np.where(new, result, values)


def find_quaternions(values: FrameByChannel, channels: Sequence[str]) -> list[list[int]]:
    """Return the channels of each quaternion."""
    found: dict[str, dict[str, int]] = {}
    for place, name in enumerate(channels):
        part = _PART.fullmatch(name)
        if part:
            found.setdefault(part[1] or "", {})[part[2].lower()] = place
    groups = [[*parts.values()] for parts in found.values() if {*parts} in _PARTS]
    return [places for places in groups if _are_rotations(values[:, places])]


def _are_rotations(numbers: NDArray[np.float64]) -> bool:
    lengths = np.linalg.norm(numbers[~np.isnan(numbers).any(axis=1)], axis=1)
    return bool(len(lengths) and np.median(np.abs(lengths - 1.0)) <= _TOLERANCE)


def _choose_signs(quaternions: NDArray[np.float64]) -> Frames:
    """Return 1 or −1 for each quaternion (N, 4), such that neighbours are alike when multiplied.

    One of which a number is missing has the sign of the one before.
    """
    signs = np.ones(len(quaternions))
    seen = np.asarray(~np.isnan(quaternions).any(axis=1))
    visible = quaternions[seen]
    turned = (visible[1:] * visible[:-1]).sum(axis=1) < 0
    signs[seen] = np.cumprod(np.concatenate([[1.0], np.where(turned, -1.0, 1.0)]))[: seen.sum()]
    before = np.maximum.accumulate(np.where(seen, np.arange(len(seen)), 0))
    return np.asarray(signs[before])
