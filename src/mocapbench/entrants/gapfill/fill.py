"""Fill gaps of markers by the functions of gapfill, as one would by hand.

A gap is filled from three markers that move most nearly as one body with it, else by the pattern of
the nearest marker, else by a spline, else on lines. Nothing is learnt from other recordings.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

vars(np)["int"] = int  # which gapfill 0.0.7 asks for, and NumPy has no more
import gapfill  # noqa: E402

__all__ = ["fill_recording"]

Values = NDArray[np.float64]


def fill_recording(values: Values, channels: list[str]) -> Values:
    """Return values (frames, channels) in which no NaN is left."""
    markers = _find_markers(channels)
    filled = values.copy()
    for name, columns in markers.items():
        others = [values[:, three] for other, three in markers.items() if other != name]
        for gap in _list_gaps(values[:, columns]):
            filled[gap, columns] = _fill_gap(values[:, columns], others, gap)[gap]
    return _interpolate_lines(filled)


def _find_markers(channels: list[str]) -> dict[str, slice]:
    """Return where the three coordinates of each marker are."""
    owners = [channel.rpartition(".")[0] for channel in channels]
    markers = {}
    for name in dict.fromkeys(filter(None, owners)):
        first = owners.index(name)
        if owners.count(name) == 3 and owners[first : first + 3] == [name] * 3:
            markers[name] = slice(first, first + 3)
    return markers


def _list_gaps(marker: Values) -> Iterator[slice]:
    hidden = np.isnan(marker).any(axis=1)
    edges = np.flatnonzero(np.diff(np.r_[False, hidden, False]))
    return (slice(*pair) for pair in edges.reshape(-1, 2))


def _fill_gap(marker: Values, others: list[Values], gap: slice) -> Values:
    """Return a marker with one gap filled, as far as a function of gapfill does it."""
    span = slice(max(gap.start - 1, 0), gap.stop + 1)
    seen = [other for other in others if np.isfinite(other[span]).all()]
    distances = [np.linalg.norm(other - marker, axis=1) for other in seen]
    both = [k for k, distance in enumerate(distances) if np.isfinite(distance).sum() > 1]
    rigid = sorted(both, key=lambda k: np.nanstd(distances[k]))[:3]
    near = sorted(both, key=lambda k: np.nanmean(distances[k]))[:1]
    ways = [(gapfill.fill_marker_gap_rbt, np.array([seen[k] for k in rigid]))] * (len(rigid) == 3)
    ways += [(gapfill.fill_marker_gap_pattern2, seen[k]) for k in near]
    for function, donor in ways:
        attempt = marker.copy()
        function(attempt, donor.copy())
        if np.isfinite(attempt[gap]).all():
            return attempt
    attempt = marker.copy()
    gapfill.fill_marker_gap_interp(attempt)
    return attempt


def _interpolate_lines(values: Values) -> Values:
    """Fill what is left on lines, level at the ends; a channel that is never seen with zeros."""
    frames = np.arange(len(values))
    filled = np.zeros_like(values)
    for column, channel in enumerate(values.T):
        seen = np.flatnonzero(np.isfinite(channel))
        if seen.size:
            filled[:, column] = np.interp(frames, seen, channel[seen])
    return filled


def _fill(folder: Path) -> None:
    for path in sorted((folder / "given").iterdir()):
        given = np.load(path)
        mean = fill_recording(given["values"], given["channels"].tolist())
        np.savez(folder / "filled" / path.name, mean=mean)


if __name__ == "__main__":
    _fill(Path(sys.argv[2]))  # after the step, which is always "fill"
