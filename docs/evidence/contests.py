"""What the contest of motion prediction on the CMU database is not said to be.

It is reported in `docs/contests.md`.

::

    python docs/evidence/contests.py [time | scale | rest | joints | seeds | means | models]...

prints what shows each, by default all. Files and recordings are read from the folders in the
environment variable MOCAPBENCH_DATA; those that are not there are passed over.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from mocapbench.benchmark import Address, Seeds, archive_at
from mocapbench.benchmark.tasks.motion_prediction import ACTIONS, motion_prediction_8_windows
from mocapbench.datasets import (
    CMULibrary,
    RotationLibrary,
    original_recordings,
    place_rotated_joints,
    rotation_skeleton,
    rotations_of,
)
from mocapbench.reports.paper.published import published_values

FILES, DATABASE = RotationLibrary(), CMULibrary()
HERE = [key for key in original_recordings() if FILES.where(key).endswith((".txt", ".gz"))]


def time() -> Iterator[str]:
    """Yield how many rows a file has, and how many frames the recording, at 120 a second."""
    for key in HERE:
        original = original_recordings()[key]
        if original and DATABASE.where(original):
            file, frames = FILES.recording(key).values, DATABASE.recording(original)
            made = rotations_of(frames, DATABASE.skeleton(original)).values
            apart = np.abs(made[:, 6:] - file[:, 6:]).max()
            yield (
                f"{key}: {len(file)} rows, {original}: {len(frames.times)} frames; "
                f"rotations differ by {apart:.1e} at most"
            )


def scale() -> Iterator[str]:
    """Yield the length of the thigh, as scored and in truth."""
    skeleton = rotation_skeleton()
    (thigh,) = (s.length for s in skeleton.segments if s.name == "LeftLeg")
    millimetres = 10 * skeleton.centimetres_per_unit
    yield f"thigh of subject 02: {70 * thigh:.0f} “mm” scored, {millimetres * thigh:.0f} mm"


def rest() -> Iterator[str]:
    """Yield how much first rows, and second ones, differ between files, in radians."""
    first, second = (
        np.stack([FILES.recording(key).values[row, 6:] for key in HERE]) for row in (0, 1)
    )
    yield f"{len(HERE)} files: first rows differ by {np.ptp(first, axis=0).max():.1e} rad at most"
    yield f"second rows by {np.ptp(second, axis=0).max():.1f} rad"


def joints() -> Iterator[str]:
    """Yield how many of the 38 joints of a file never move, and how many are distinct."""
    placed = place_rotated_joints(FILES.recording(HERE[0]).values)
    moving = np.ptp(placed, axis=0).max(axis=1) > 0
    distinct = len(np.unique(placed[:, moving].round(9), axis=1)[0])
    yield f"{(~moving).sum()} of {len(moving)} joints never move; {distinct} others are distinct"


def seeds() -> Iterator[str]:
    """Yield where the eight windows of each action begin."""
    for action in ACTIONS:
        case = motion_prediction_8_windows.case(f"{action.replace('_', '-')} 35 files")
        assert isinstance(case.problem, partial)
        few = case.problem.keywords | {"training": ()}
        address = Address("motion-prediction-8-windows", 1, case.name, 0)
        problem = case.problem.func(Seeds(0, address), archive_at(), **few)
        starts = sorted(round(60 * window.times[0]) for window in problem.given)
        yield f"{action}: {starts}"


def means() -> Iterator[str]:
    """Yield printed means, and those of the printed rows, at 80 and 1000 ms."""
    values = published_values("motion-prediction")
    for model in dict.fromkeys(model for _, _, model in values):
        for metric in ("MPJPE at 80 ms", "MPJPE at 1000 ms"):
            by_row = {
                row: v.value for (row, m, who), v in values.items() if (m, who) == (metric, model)
            }
            rows = [by_row[action] for action in ACTIONS if action in by_row]
            printed = {row: value for row, value in by_row.items() if row.startswith("mean")}
            if rows and printed:
                yield f"{model}, {metric}: {len(rows)} rows {np.mean(rows):.2f}, printed {printed}"


def models() -> Iterator[str]:
    """Yield what is printed of walking at 1000 ms, by model."""
    for (row, metric, model), value in sorted(published_values("motion-prediction").items()):
        if (row, metric) == ("walking", "MPJPE at 1000 ms"):
            yield f"{model}: {value.value}"


SHOWN = {f.__name__: f for f in (time, scale, rest, joints, seeds, means, models)}


def main(names: Sequence[str]) -> None:
    """Print what shows each of the names."""
    for name in names or SHOWN:
        print(f"## {name}")
        for line in SHOWN[name]():
            print(line, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
