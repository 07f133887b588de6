"""Gaps to hide, so that it is known what a model should have filled."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from mocapbench.baselines.common.markers import marker_places
from mocapbench.benchmark.filling.gaps import Gap, mask_gaps
from mocapbench.benchmark.filling.requests.names import name_owners
from mocapbench.benchmark.in_memory.arguments import require_count, require_positive
from mocapbench.benchmark.task_files.hiding import (
    HidingError,
    gap_length,
    group_columns,
    place_gaps,
)
from mocapbench.benchmark.tasks.marker_gaps import LIMBS
from mocapbench.datasets import Recording

__all__ = ["Gaps"]

_TOGETHER = 4
"""Markers of a limb where no joints have the names of those of a skeleton."""
_LOOKED_AT = 200
"""Frames by which distances of markers are told."""


@dataclass(frozen=True)
class Gaps:
    """Gaps to hide where a recording is visible; the seed alone decides where.

    Parameters
    ----------
    seconds : float
        How long each gap is.
    what : str, default="marker"
        What each hides: a ``"channel"``, a ``"marker"`` or joint, a ``"limb"``, or all channels of
        whole ``"frames"``. A limb is an arm or a leg of the joints of the CMU Motion Capture
        Database, and else a marker with the three that are nearest to it.
    count : int, default=5
        How many are in each recording.
    seed : int, default=0

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench import Gaps
    >>> from mocapbench.datasets import Recording
    >>> walk = Recording("walk", np.arange(9) / 10, np.zeros((9, 1)), ["knee.rx"], ["deg"])
    >>> (gap,) = Gaps(seconds=0.3, count=1).place(walk)
    >>> len(gap), gap.channels
    (3, (0,))
    """

    seconds: float
    what: str = "marker"
    count: int = 5
    seed: int = 0

    def __post_init__(self) -> None:
        require_positive("seconds", self.seconds)
        if self.what not in _GROUPS:
            raise ValueError(f"expected what= as one of {', '.join(_GROUPS)}, got {self.what!r}")
        require_count("count", self.count)

    def place(self, recording: Recording) -> tuple[Gap, ...]:
        """Return the gaps of a recording, by their first frame.

        Raises
        ------
        ValueError
            If it has no room for them.
        """
        rng = np.random.default_rng(self.seed)
        gaps: list[Gap] = []
        try:
            length, groups = gap_length(self.seconds, recording), _GROUPS[self.what](recording)
            for _ in range(self.count):
                ((start, columns),) = _place_apart(recording, rng, groups, length, gaps)
                gaps.append(Gap(start, start + length, tuple(sorted(columns))))
        except HidingError as error:
            room = f"; there is room for {len(gaps)} of {self.count} gaps" if gaps else ""
            raise ValueError(
                f"{recording.name}: {error}{room}; hide fewer or shorter gaps"
            ) from error
        return tuple(sorted(gaps))


def _place_apart(
    recording: Recording,
    rng: np.random.Generator,
    groups: Sequence[Sequence[int]],
    length: int,
    others: Sequence[Gap],
) -> list[tuple[int, Sequence[int]]]:
    """Return one more gap, which shares no frames with others if there is room for that."""
    hidden = mask_gaps(others, recording.values.shape)
    apart = recording.hide(hidden.any(axis=1, keepdims=True))
    try:
        return place_gaps(apart, rng, groups, length, 1)
    except HidingError:
        return place_gaps(recording.hide(hidden), rng, groups, length, 1)


def _group_limbs(recording: Recording) -> list[list[int]]:
    """Return the columns of each limb, known by its name or by what is near."""
    columns: dict[str, list[int]] = defaultdict(list)
    for column, owner in enumerate(name_owners(recording.channels)):
        columns[owner].append(column)
    named = [[k for joint in limb for k in columns.get(joint, ())] for limb in LIMBS.values()]
    return [*filter(None, named)] or _group_neighbours(recording)


def _group_neighbours(recording: Recording) -> list[list[int]]:
    """Return the columns of each marker, with those of the markers that are nearest to it."""
    places = marker_places(recording.channels, recording.units)
    if len(places) < _TOGETHER:
        raise HidingError(
            f"an arm or a leg of a CMU skeleton, or {_TOGETHER} markers, to hide a limb",
            f"{len(places)} markers",
        )
    step = max(1, len(recording.times) // _LOOKED_AT)
    points = recording.values[::step, places]  # (n, M, 3)
    apart = np.linalg.norm(points[:, :, np.newaxis] - points[:, np.newaxis], axis=-1)
    distances = np.nan_to_num(np.nanmedian(apart, axis=0), nan=np.inf)
    np.fill_diagonal(distances, -1.0)  # each marker is the nearest to itself
    nearest = np.argsort(distances, axis=1, kind="stable")[:, :_TOGETHER]
    groups: list[list[int]] = places[nearest].reshape(len(places), -1).tolist()
    return groups


_GROUPS: Mapping[str, Callable[[Recording], list[list[int]]]] = {
    "channel": partial(group_columns, together="channel"),
    "marker": partial(group_columns, together="joint"),
    "limb": _group_limbs,
    "frames": group_columns,
}
