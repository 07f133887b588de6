"""Datasets of the package movement: positions of keypoints over time, in xarray."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.in_memory.extras import require_extra
from mocapbench.datasets import Frames, Mask, Recording, frame_rate

__all__ = ["read_movement", "to_movement"]

_DIMENSIONS = ("time", "space", "keypoints", "individuals")
_IN_ORDER = ("time", "individuals", "keypoints", "space")
"""In the order of channels: those of a keypoint together, and those of an individual."""
_SINGULAR = {"keypoint": "keypoints", "individual": "individuals"}
"""What some versions of movement call these."""
_POSITION, _CONFIDENCE = "position", "confidence"


def read_movement(
    data: Any,
    rate: float | None = None,
    name: str = "recording",
    min_likelihood: float | None = None,
) -> Recording:
    """Return the recording of positions.

    Parameters
    ----------
    data : xarray.Dataset or xarray.DataArray
        With the variable ``position``, or that variable: its dimensions are time, space, keypoints
        and, optionally, individuals, in any order.
    rate : float or None
        Frames per second, in place of the times.
    name : str
        Of the recording.
    min_likelihood : float or None
        Keypoints of less ``confidence`` are hidden.

    Returns
    -------
    Recording
        Channels are called ``LKNE.x``, or ``Ann:LKNE.x`` if there are several individuals.

    Raises
    ------
    ValueError
        If it is no such dataset.
    """
    data = data.rename({one: many for one, many in _SINGULAR.items() if one in data.dims})
    position = _find_position(data)
    values = np.array(position.values, dtype=float)
    if min_likelihood is not None:
        values[_mark_unlikely(data, position, min_likelihood)] = np.nan
    labels = [[str(one) for one in _list_labels(position, name)] for name in position.dims[1:]]
    channels = [_name_channel(*reversed(parts)) for parts in product(*labels)]
    unit = str(position.attrs.get("units", ""))
    times = _find_times(position, data, rate)
    return Recording(
        name, times, values.reshape(len(times), -1), tuple(channels), (unit,) * len(channels)
    )


def _find_position(data: Any) -> Any:
    """Return the positions, with their dimensions in order, without that of a single individual."""
    variables = getattr(data, "data_vars", {_POSITION: data})
    position: Any = variables.get(_POSITION)
    dims = () if position is None else position.dims
    if {*dims} - {*_DIMENSIONS} or {*_DIMENSIONS[:3]} - {*dims}:
        raise ValueError(
            "expected positions with the dimensions time, space, keypoints and, optionally, "
            f"individuals, got {', '.join(map(str, dims)) or 'none'}"
        )
    if position.dtype.kind != "f":
        raise ValueError(
            f"expected floating-point positions, NaN where one is hidden, got {position.dtype}"
        )
    if position.sizes.get("individuals") == 1:
        position = position.isel(individuals=0, drop=True)
    return position.transpose(*(name for name in _IN_ORDER if name in position.dims))


def _list_labels(position: Any, dimension: str) -> Sequence[Any]:
    if dimension in position.coords:
        return list(position.coords[dimension].values)
    numbers = range(position.sizes[dimension])
    return list("xyz")[: len(numbers)] if dimension == "space" else list(numbers)


def _name_channel(axis: str, keypoint: str, individual: str = "") -> str:
    return f"{individual}:{keypoint}.{axis}" if individual else f"{keypoint}.{axis}"


def _mark_unlikely(data: Any, position: Any, least: float) -> Mask:
    """Return the coordinates of keypoints of less confidence."""
    if _CONFIDENCE not in getattr(data, "data_vars", ()):
        raise ValueError("expected a variable confidence for min_likelihood=, got none")
    confidence = data[_CONFIDENCE].broadcast_like(data[_POSITION])
    if "individuals" not in position.dims:
        confidence = confidence.isel(individuals=0, drop=True, missing_dims="ignore")
    mask: Mask = confidence.transpose(*position.dims).values < least
    return mask


def _find_times(position: Any, data: Any, rate: float | None) -> Frames:
    """Return seconds; frames without a rate have none."""
    n_frames = position.sizes["time"]
    if rate is not None:
        if not 0 < rate < np.inf:
            raise ValueError(f"expected rate= in frames per second, above 0, got {rate}")
        return np.arange(n_frames) / rate
    attributes = {**position.attrs, **data.attrs}
    if "time" not in position.coords or attributes.get("time_unit", "seconds") != "seconds":
        raise ValueError("expected times in seconds, got frames; name rate= in frames per second")
    times = position.coords["time"].values
    if times.dtype.kind == "m":
        return np.asarray(times / np.timedelta64(1, "s"), dtype=float)
    return np.asarray(times, dtype=float)


def to_movement(recording: Recording, deviations: Array) -> Any:
    """Return a dataset of the layout of movement, with the variable ``std`` besides.

    Parameters
    ----------
    recording : Recording
        Of which all channels are coordinates, such as ``LKNE.x`` or ``Ann:LKNE.x``.
    deviations : ndarray of shape (N, D)
        Of its values.

    Raises
    ------
    ValueError
        If other channels are among them, or a keypoint lacks a coordinate.
    """
    xarray = require_extra("xarray", "to_xarray")
    labels = [_split_channel(channel) for channel in recording.channels]
    coordinates = [[*dict.fromkeys(each)] for each in zip(*labels, strict=True)]
    wanted = [*product(*coordinates)]
    if {*wanted} != {*labels}:
        axis, keypoint, individual = next(one for one in wanted if one not in {*labels})
        missing = _name_channel(axis, keypoint, individual)
        raise ValueError(
            f"expected the same coordinates of every keypoint, got no channel {missing}; "
            "use to_dataframe()"
        )
    order = [labels.index(parts) for parts in wanted]
    shape = (len(recording.times), *map(len, coordinates))
    units = ", ".join(dict.fromkeys(filter(None, recording.units)))
    about = {"units": units} if units else {}

    def arrange(values: Array) -> Array:
        return values[:, order].reshape(shape)

    unknown = np.full((shape[0], *shape[2:]), np.nan)
    return xarray.Dataset(
        {
            _POSITION: (_DIMENSIONS, arrange(recording.values), about),
            "std": (_DIMENSIONS, arrange(deviations), about),
            _CONFIDENCE: (("time", *_DIMENSIONS[2:]), unknown),
        },
        {
            "time": recording.times,
            **dict(zip(_DIMENSIONS[1:], [*coordinates[:2], _name(coordinates[2])], strict=True)),
        },
        {"ds_type": "poses", "time_unit": "seconds", "fps": frame_rate(recording)},
    )


def _name(individuals: list[str]) -> list[str]:
    """Return names of individuals; the only one, which has none, as movement calls it."""
    return ["id_0"] if individuals == [""] else individuals


def _split_channel(channel: str) -> tuple[str, str, str]:
    """Return the axis, the keypoint and the individual of a channel."""
    owner, _, axis = channel.rpartition(".")
    if not owner or axis.lower() not in {*"xyz"}:
        raise ValueError(
            f"expected channels that are coordinates, such as LKNE.x, got {channel}; "
            "use to_dataframe()"
        )
    individual, _, keypoint = owner.rpartition(":")
    return axis.lower(), keypoint, individual
