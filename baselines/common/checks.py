"""Checks of the recordings that models are given, in `fit` alone or in `impute` besides."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import stack
from mocapbench.datasets import Recording, ToyProcess, frame_rate
from mocapbench.datasets.formats.sets import same_rate

__all__ = [
    "check_channels",
    "check_given",
    "check_known",
    "check_outputs",
    "check_rates",
    "check_recordings",
    "check_spread",
    "check_visible",
    "pool",
]

_LARGEST = 1e75
"""Of the sizes of values: models take up to fourth powers, and floats end at 1.8e308."""


def check_recordings(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Return the recordings as a tuple, after checking that they can be stacked.

    Raises
    ------
    ValueError
        If it is not a sequence of recordings, there is none, channels or units differ, a name
        repeats, or one has no frame, no channel or values beyond 1e75.
    """
    checked = _list_recordings(recordings)
    if not checked:
        raise ValueError("expected at least one recording, got none")
    check_channels(checked, checked[0].channels, checked[0].units)
    names = [recording.name for recording in checked]
    if len(set(names)) != len(names):
        repeated = sorted({name for name in names if names.count(name) > 1})
        raise ValueError(f"expected recordings with distinct names, got {repeated} repeatedly")
    return checked


def check_channels(
    recordings: Sequence[Recording], channels: tuple[str, ...], units: tuple[str, ...]
) -> None:
    """Check that every recording has the given channels, in the same order and the same units.

    It also checks that each has at least one frame, and values whose powers do not overflow.

    Raises
    ------
    ValueError
        If it is not a sequence of recordings, or one has other channels or units, no frame, no
        channel or values beyond 1e75.
    """
    for recording in _list_recordings(recordings):
        if recording.channels != channels:
            raise ValueError(
                f"recording {recording.name!r}: expected channels {channels}, "
                f"got {recording.channels}; select the same channels of every recording"
            )
        _check_units(recording, units)
        _check_values(recording)


def check_given(model: Any, recordings: Sequence[Recording]) -> None:
    """Check that a model is fitted, and to recordings of the channels and units of these.

    Parameters
    ----------
    model : Model
        With the attributes ``channels_`` and ``units_`` once it is fitted.
    recordings : sequence of Recording
        Of which it is asked something.

    Raises
    ------
    sklearn.exceptions.NotFittedError
        If it is not fitted.
    ValueError
        See `check_channels`.
    """
    check_is_fitted(model)
    check_channels(recordings, model.channels_, model.units_)


def _list_recordings(recordings: object) -> tuple[Recording, ...]:
    """Return the recordings as a tuple, or say what was given in their place."""
    kind = type(recordings).__name__
    if not isinstance(recordings, Collection):  # An iterator would be spent after this check.
        raise ValueError(
            f"expected a sequence of Recordings, got {kind}; put one or more into a list"
        )
    listed = tuple(recordings)
    for item in listed:
        if not isinstance(item, Recording):
            raise ValueError(
                f"expected a sequence of Recordings, got {kind} of {type(item).__name__}; "
                "make a Recording of each array of values"
            )
    return listed


def _check_units(recording: Recording, units: tuple[str, ...]) -> None:
    for channel, expected, got in zip(recording.channels, units, recording.units, strict=True):
        if got != expected:
            raise ValueError(
                f"recording {recording.name!r}: expected channel {channel!r} in unit {expected!r} "
                f"as in the other recordings, got {got!r}; convert one of them"
            )


def _check_values(recording: Recording) -> None:
    if not recording.values.size:
        raise ValueError(
            f"recording {recording.name!r}: expected at least one frame and one channel, "
            f"got {recording.values.shape} of them; leave it out"
        )
    values = recording.values.ravel()
    largest = max(np.fmax.reduce(values, initial=0.0), -np.fmin.reduce(values, initial=0.0))
    if largest > _LARGEST:
        raise ValueError(
            f"recording {recording.name!r}: expected values of at most {_LARGEST:g} in size, "
            f"got {largest:g}; use another unit"
        )


def check_outputs(recordings: Sequence[Recording], process: ToyProcess) -> None:
    """Check that recordings with the same channels have one for each output of a process.

    Raises
    ------
    ValueError
        If the numbers differ.
    """
    n_channels = len(recordings[0].channels)
    if n_channels != process.n_outputs:
        raise ValueError(
            f"expected the process's {process.n_outputs} outputs, "
            f"got recordings of {n_channels} channels"
        )


def check_rates(recordings: Sequence[Recording]) -> None:
    """Check that recordings have the same frame rate; one of a single frame may have any.

    Raises
    ------
    ValueError
        If rates differ by more than 1 %, as for files in `mocapbench.datasets.check_alike`.
    """
    first, *others = [one for one in recordings if len(one.times) > 1] or recordings
    for other in others:
        if not same_rate(first, other):
            raise ValueError(
                f"recording {other.name!r}: expected {frame_rate(first):.6g} frames per second as "
                f"in {first.name!r}, got {frame_rate(other):.6g}; resample one of them"
            )


def check_visible(recordings: Sequence[Recording]) -> None:
    """Check that every channel is visible somewhere.

    Raises
    ------
    ValueError
        If one is hidden in all recordings.
    """
    unseen = np.asarray(np.isnan(stack(recordings)).all(axis=0))
    if unseen.any():
        channels = _name_channels(recordings[0], unseen)
        raise ValueError(
            f"expected a visible entry of every channel in some recording, got none of {channels}; "
            "leave these channels out with Recording.select"
        )


def check_known(recording: Recording, known: NDArray[np.bool_]) -> None:
    """Check that every channel of a recording to fill is known, from itself or from training.

    Parameters
    ----------
    recording : Recording
    known : ndarray of bool, shape (D,)
        Which channels have a visible entry in it or in the recordings given to ``fit``.

    Raises
    ------
    ValueError
        If one is not.
    """
    if not known.all():
        raise ValueError(
            f"recording {recording.name!r}: expected a visible entry of every channel here or in "
            f"the recordings given to fit, got none of {_name_channels(recording, ~known)}; leave "
            "these channels out with Recording.select"
        )


def check_spread(recordings: Sequence[Recording]) -> None:
    """Check that no channel has a single visible entry in all recordings together.

    One tells nothing of how far a channel goes, so that no interval around it means anything.

    Raises
    ------
    ValueError
        If one has.
    """
    counts = (~np.isnan(stack(recordings))).sum(axis=0)
    if (counts == 1).any():
        channels = _name_channels(recordings[0], counts == 1)
        raise ValueError(
            f"expected at least two visible entries of every channel, got one of {channels}, which "
            "tells nothing of how far it goes: learn from recordings that show more of it, or "
            "leave it out with Recording.select"
        )


def _name_channels(recording: Recording, which: NDArray[np.bool_]) -> list[str]:
    return [recording.channels[d] for d in np.flatnonzero(which)]


def pool(fitted: Sequence[Recording], given: Sequence[Recording]) -> tuple[Recording, ...]:
    """Return the recordings given to fit or impute, each name once.

    A recording given to both is taken as given to impute.

    Raises
    ------
    ValueError
        If ``given`` is not a sequence of recordings, there is none, or channels or units differ.
    """
    named = {recording.name: recording for recording in (*fitted, *_list_recordings(given))}
    return check_recordings(tuple(named.values()))
