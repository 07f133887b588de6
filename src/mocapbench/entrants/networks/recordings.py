"""Recordings as windows of scaled values, of which networks learn, and which they fill."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Filling",
    "cut_windows",
    "fill_recordings",
    "hide_gaps",
    "interpolate_lines",
    "load_windows",
    "split_recordings",
]

Values = NDArray[np.float64]
Filling = Callable[[Values], Mapping[str, Values]]
"""From windows, in which NaN is hidden, to ``mean`` and ``std`` of the same shape, or ``samples``,
which have draws on a second axis."""

_HELD_OUT = 5
"""One recording of so many is held out, at least one; of a single one, the end."""
_LONGEST_GAP = 0.6
"""Of a window, what a gap that is drawn hides at the most."""
_WHOLE, _MOST_GAPS = 1 / 4, 3
"""How often a gap that is drawn hides all channels, and how many a window has at the most."""


def load_windows(
    folder: Path, longest: int, rng: np.random.Generator
) -> tuple[Values, Values, list[NDArray[np.intp]]]:
    """Read what may be learnt from, and leave in the model's folder how values are scaled.

    Returns
    -------
    training, held_out : arrays (windows, frames, channels)
        Of different recordings where there are two or more.
    parts : list of arrays of int
        The channels of each joint or marker: those whose names differ after the last dot alone.
    """
    paths = sorted((folder / "train").iterdir())
    recordings = [np.load(path)["values"] for path in paths]
    first = np.load(paths[0])
    centre, spread = _find_scale(np.concatenate(recordings), first["units"])
    length = min(longest, max(map(len, recordings)))
    np.savez(folder / "model" / "scale.npz", length=length, centre=centre, spread=spread)
    scaled = [(values - centre) / spread for values in recordings]
    training, held_out = (
        np.concatenate([cut_windows(values, length, 8) for values in some])
        for some in split_recordings(scaled, rng)
    )
    owners = np.array([name.rpartition(".")[0] or name for name in first["channels"]])
    parts = [np.flatnonzero(owners == owner) for owner in dict.fromkeys(owners)]
    return training, held_out, parts


def _find_scale(frames: Values, units: NDArray[np.str_]) -> tuple[Values, Values]:
    """Return the mean of each channel, and one spread for all of a unit: errors count alike."""
    seen = np.isfinite(frames)
    counts = np.maximum(seen.sum(axis=0), 1)
    centre = np.where(seen, frames, 0.0).sum(axis=0) / counts
    variance = (np.where(seen, frames - centre, 0.0) ** 2).sum(axis=0) / counts
    spread = np.ones_like(variance)
    for unit in set(units.tolist()):
        spread[units == unit] = np.sqrt(variance[units == unit].mean()) or 1.0
    return centre, spread


def split_recordings(
    recordings: Sequence[Values], rng: np.random.Generator
) -> tuple[list[Values], list[Values]]:
    """Return recordings to learn from, and others that say when to stop."""
    if len(recordings) == 1:
        (values,) = recordings
        begin = max(1, len(values) * 3 // 4)
        return [values[:begin]], [values[begin:]]
    order = rng.permutation(len(recordings))
    n_held_out = max(1, len(recordings) // _HELD_OUT)
    held_out, training = order[:n_held_out], order[n_held_out:]
    return [recordings[k] for k in training], [recordings[k] for k in held_out]


def cut_windows(values: Values, length: int, step: int) -> Values:
    """Return windows of a recording, the last of which ends with it; a short one has NaN then."""
    missing = max(0, length - len(values))
    values = np.concatenate([values, np.full((missing, values.shape[1]), np.nan)])
    return np.stack(
        [values[start : start + length] for start in _list_starts(values, length, step)]
    )


def _list_starts(values: Values, length: int, step: int) -> list[int]:
    return [*range(0, len(values) - length, step), len(values) - length]


def hide_gaps(
    shape: tuple[int, ...], parts: Sequence[NDArray[np.intp]], rng: np.random.Generator
) -> NDArray[np.bool_]:
    """Return gaps in each window: of all channels, or of parts that are listed side by side.

    So are the joints of a limb.
    """
    n_windows, length, _ = shape
    hidden = np.zeros(shape, dtype=bool)
    for window in np.repeat(range(n_windows), rng.integers(1, _MOST_GAPS + 1, n_windows)):
        n_frames = rng.integers(1, max(2, int(_LONGEST_GAP * length)))
        begin = rng.integers(0, length - n_frames + 1)
        most = len(parts) if rng.random() < _WHOLE else rng.integers(1, len(parts) // 2 + 2)
        n_parts = int(min(most, len(parts)))
        first = int(rng.integers(0, len(parts) - n_parts + 1))
        channels = np.concatenate(parts[first : first + n_parts])
        hidden[window, begin : begin + n_frames, channels] = True
    return hidden


def interpolate_lines(windows: Values) -> tuple[Values, Values]:
    """Return windows with lines where entries are hidden, and how far each is from a visible one.

    Beyond the outermost visible entries lines are level; where a channel has none, they are at its
    mean. Distances are logarithms of frames.
    """
    n_windows, length, n_channels = windows.shape
    lines, away = np.zeros_like(windows), np.full_like(windows, np.log1p(length))
    frames = np.arange(length)
    for window, channel in np.ndindex(n_windows, n_channels):
        values = windows[window, :, channel]
        seen = np.flatnonzero(np.isfinite(values))
        if seen.size:
            lines[window, :, channel] = np.interp(frames, seen, values[seen])
            after = seen[np.searchsorted(seen, frames).clip(max=seen.size - 1)]
            before = seen[(np.searchsorted(seen, frames, side="right") - 1).clip(min=0)]
            nearest = np.minimum(np.abs(after - frames), np.abs(frames - before))
            away[window, :, channel] = np.log1p(nearest)
    return lines, away


def fill_recordings(folder: Path, fill: Filling) -> None:
    """Fill all recordings that are given, in windows of which each gives the frames at its middle.

    Parameters
    ----------
    folder : Path
        As the command is given it.
    fill : callable
        What fills windows of scaled values.
    """
    with np.load(folder / "model" / "scale.npz") as scale:
        centre, spread, length = scale["centre"], scale["spread"], int(scale["length"])
    for path in sorted((folder / "given").iterdir()):
        values = (np.load(path)["values"] - centre) / spread
        windows = cut_windows(values, length, max(1, length // 2))
        filled = {
            name: _join_windows(name, array, values, length)
            for name, array in fill(windows).items()
        }
        scaled = {
            name: array * spread + (0.0 if name == "std" else centre)
            for name, array in filled.items()
        }
        np.savez(folder / "filled" / path.name, **scaled)


def _join_windows(name: str, windows: Values, values: Values, length: int) -> Values:
    """Return an array of a whole recording from those of its windows."""
    padded = max(len(values), length)
    starts = np.array(_list_starts(np.empty((padded, 0)), length, max(1, length // 2)))
    frames = np.arange(len(values))
    nearest = np.abs(frames[:, None] - (starts + length / 2)[None]).argmin(axis=1)
    if name == "samples":
        joined = windows[nearest, :, frames - starts[nearest]].swapaxes(0, 1)
        return np.where(np.isfinite(values)[None], values[None], joined)
    joined = windows[nearest, frames - starts[nearest]]
    return joined if name == "std" else np.where(np.isfinite(values), values, joined)
