"""Channels of several units in common ones, for distances between poses.

Such a distance adds up squares over channels, which their units therefore weigh: in radians, angles
would hardly count beside the place of the body, in millimetres nothing else would. Known units are
converted to those of the CMU database, with which the models were developed and published figures
were computed: degrees, and the length that its skeletons have as their unit, 1/0.45 inch (5.64 cm).
Rates follow what they are rates of: ``rad/s`` becomes degrees a second. Others are left as they
are, such as ``""``, the unit of lengths in the Acclaim and BVH formats. Where all channels have the
same unit, it does not weigh one against another, and values stay as they are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["from_pose_units", "in_pose_units", "pose_factors"]


_CENTIMETRES = 2.54 / 0.45
"""In the unit of length of the CMU database's skeletons."""
_FACTORS: Mapping[str, float] = {
    "deg": 1.0,
    "rad": 180.0 / np.pi,
    "mm": 0.1 / _CENTIMETRES,
    "cm": 1.0 / _CENTIMETRES,
    "m": 100.0 / _CENTIMETRES,
}


def pose_factors(units: Sequence[str]) -> Array:
    """Return what values of channels in ``units`` are multiplied by: (D,).

    Parameters
    ----------
    units : sequence of D str
        The unit of each channel. All factors are 1 if it is the same for all.
    """
    alike = len(set(units)) == 1
    return np.array([1.0 if alike else _FACTORS.get(unit.partition("/")[0], 1.0) for unit in units])


def in_pose_units(recording: Recording) -> Recording:
    """Return the recording with values that distances may be measured over.

    A recording that is returned by this function is not changed by it.
    """
    factors = pose_factors(recording.units)
    if (factors == 1.0).all():
        return recording
    return replace(recording, values=recording.values * factors, units=("",) * len(factors))


def from_pose_units(
    recording: Recording, mean: FrameByChannel, variance: FrameByChannel | None = None
) -> Prediction:
    """Return a prediction of a recording from ``mean`` and ``variance`` of `in_pose_units` of it.

    Visible entries are copied from the recording as it is given here.
    """
    factors = pose_factors(recording.units)
    variance = None if variance is None else variance / factors**2
    return Prediction.around(recording, mean / factors, variance)
