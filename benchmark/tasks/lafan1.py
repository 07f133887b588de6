"""In-betweening on LaFAN1: ten frames and a target are seen, and the 5 to 45 between asked.

F. G. Harvey, M. Yurick, D. Nowrouzezahrai and C. Pal 2020, *Robust Motion In-betweening*, by the
public code of its data set. The data are a user's own, and nobody has run this on them here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from mocapbench.benchmark.problems.in_between import (
    InBetweenProblem,
    QuaternionBody,
    rotation_channels,
)
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.lafan1 import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import (
    FRAME_RATE,
    Archive,
    FrameByJointBy3,
    Recording,
    Skeleton,
    rotation_skeleton,
    rotations_of,
)
from mocapbench.datasets.lafan1.takes import SUBJECTS
from mocapbench.datasets.lafan1.unit_quaternions import (
    keep_signs,
    place_joints,
    quaternions_of_vectors,
)
from mocapbench.datasets.lafan1.windows import (
    N_PAST,
    Take,
    cut_windows,
    offsets_of,
    split_takes,
)

__all__ = ["LENGTHS", "lafan1", "lafan1_problem", "measure_spread"]

LENGTHS = (5, 15, 30, 45)
"""Frames of a gap."""
RATE = 30
TESTED = (65, 40)
"""Frames of a window that is tested, and from where one begins to the next."""
MEASURED = (50, 20)
"""The same of windows whose standard deviations errors are divided by."""
LEARNT = (50, 50)
"""The same of windows that models learn from, so that these hold every frame once."""

REAL = (("lafan1:subject5",), tuple(f"lafan1:{subject}" for subject in SUBJECTS[:4]))
SYNTHETIC = (("gait:04_01", "gait:04_02"), ("gait:01_01", "gait:02_01", "gait:03_02"))
"""Which recordings are tested, and which are learnt from."""


def lafan1_problem(
    seeds: Seeds,
    archive: Archive,
    *,
    n_hidden: int,
    tested: tuple[str, ...],
    training: tuple[str, ...],
) -> InBetweenProblem:
    """Hide frames after the tenth of every window.

    Parameters
    ----------
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`. Nothing is drawn.
    n_hidden : int
        How many frames; that after them is visible, and the last.
    tested, training : tuple of str
        Addresses of recordings.
    """
    del seeds
    takes, learnt = _read_takes(archive, tested), _read_takes(archive, training)
    skeleton = _skeleton_of(archive, training[0])
    frames = slice(N_PAST + n_hidden + 1)
    windows = [*_list_windows(skeleton, cut_windows(takes, *TESTED), frames)]
    shown = np.arange(N_PAST + n_hidden + 1)
    hidden = ((shown >= N_PAST) & (shown < N_PAST + n_hidden))[:, np.newaxis]
    return InBetweenProblem(
        train=tuple(_list_windows(skeleton, cut_windows(learnt, *LEARNT), slice(None), "learnt")),
        given=tuple(window.hide(hidden) for window in windows),
        truth=tuple(window.values for window in windows),
        unit=Unit.natural(len(windows[0].channels)),
        body=QuaternionBody(skeleton, measure_spread(learnt, skeleton)),
    )


def measure_spread(takes: Sequence[Take], skeleton: Skeleton) -> FrameByJointBy3:
    """Return the standard deviation (J, 3) in cm of each coordinate over all windows of takes."""
    moments = [_measure_take(take, skeleton) for take in takes if len(take[0]) > MEASURED[0]]
    shares, means, variances = (np.array(part) for part in zip(*moments, strict=True))
    mean = np.average(means, axis=0, weights=shares)
    # The variance of all is that within takes and that between their means.
    return np.asarray(np.sqrt(np.average(variances + (means - mean) ** 2, axis=0, weights=shares)))


def _measure_take(take: Take, skeleton: Skeleton) -> tuple[int, FrameByJointBy3, FrameByJointBy3]:
    """Return how many windows a take has, and means and variances (J, 3) in cm over them.

    Takes are measured one by one, since windows overlap and all of them would fill memory.
    """
    offsets = offsets_of(skeleton) * skeleton.centimetres_per_unit
    _, placed = place_joints(*cut_windows([take], *MEASURED), offsets, skeleton.parents)
    return len(placed), placed.mean(axis=(0, 1)), placed.var(axis=(0, 1))


def _list_windows(
    skeleton: Skeleton, windows: Take, frames: slice, kind: str = "window"
) -> Iterator[Recording]:
    """Yield some frames of each window as a recording."""
    channels = rotation_channels(skeleton)
    units = tuple("cm" if ".t" in channel else "" for channel in channels)
    for number, (path, rotations) in enumerate(zip(*windows, strict=True), start=1):
        values = np.hstack([path, rotations.reshape(len(path), -1)])[frames]
        times = np.arange(len(values)) / RATE
        yield Recording(f"{kind} {number}", times, values, channels, units)


def _read_takes(archive: Archive, uris: Sequence[str]) -> list[Take]:
    """Return the takes of recordings, in cm and at 30 frames per second."""
    return [take for uri in uris for take in _split_recording(archive, uri)]


def _split_recording(archive: Archive, uri: str) -> Iterator[Take]:
    recording, skeleton = archive.recording(uri), archive.skeleton(uri)
    if uri.startswith("gait:"):
        return iter([_take_of_gait(recording, skeleton)])
    return split_takes(recording, skeleton)


def _skeleton_of(archive: Archive, uri: str) -> Skeleton:
    return rotation_skeleton() if uri.startswith("gait:") else archive.skeleton(uri)


def _take_of_gait(recording: Recording, skeleton: Skeleton) -> Take:
    """Return generated gait on the body of motion prediction, whose vectors rotate rows."""
    moving = rotations_of(recording, skeleton).values[1 :: round(FRAME_RATE / RATE)]
    vectors = -moving[:, 3:].reshape(len(moving), -1, 3)
    path = moving[:, :3] * rotation_skeleton().centimetres_per_unit
    return path, keep_signs(quaternions_of_vectors(vectors))


def _build_case(n_hidden: int, *, synthetic: bool) -> Case:
    tested, training = SYNTHETIC if synthetic else REAL
    return Case(
        f"{'synthetic ' if synthetic else ''}{n_hidden} frames",
        partial(lafan1_problem, n_hidden=n_hidden, tested=tested, training=training),
        {"frames": n_hidden},
        (*tested, *training),
        training="three generated walkers" if synthetic else "subjects 1 to 4",
        synthetic=synthetic,
    )


_CASES = (
    *(_build_case(n_hidden, synthetic=False) for n_hidden in LENGTHS),
    _build_case(15, synthetic=True),
)
_NOT_CHEAP = (
    *("aligned-window", "best-of", "channel-kriging", "cyclic-alignment", "fam", "gpdm"),
    *("gplvm", "lds", "low-rank", "pca-regression", "pose-kriging", "pose-viterbi"),
)
"""They fill each of thousands of windows anew, or learn from half a million frames, in hours."""

lafan1: Task = Task(
    name="lafan1",
    version=1,
    page=PAGE,
    requires={"fills frames", "fills new recordings"},
    cases=_CASES,
    entrants=(Entrant("zero-velocity", "hold"),),
    profiles={
        "smoke": Profile(("synthetic 15 frames",), 1, {"max_iter": 2}, _NOT_CHEAP),
        "paper": Profile(on_recordings(_CASES), 1, {}, _NOT_CHEAP),
    },
    max_folds=1,
    independent_folds=False,
)
"""Whole frames are hidden between ten that are seen and a target."""
