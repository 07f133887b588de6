"""Motion prediction on the CMU database, as contests have it: ten frames seen, the next 25 asked.

After W. Mao, M. Liu, M. Salzmann and H. Li 2019, *Learning Trajectory Dependencies for Human Motion
Prediction*, and L. Dang, Y. Nie, C. Long, Q. Zhang and G. Li 2021, *MSR-GCN*, whose code differs
from their papers. Beside the protocol as it is run stands a corrected one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.body import JointByChannel
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.pages.motion_prediction import (
    ALL_WINDOWS,
    CORRECTED,
    EIGHT_WINDOWS,
)
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import (
    PREDICTED,
    Archive,
    FrameByJointBy3,
    Recording,
    Skeleton,
    coincident_joints,
    complete_joints,
    original_recordings,
    place_rotated_joints,
    rotation_skeleton,
    rotations_of,
)
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = [
    "ACTIONS",
    "N_AHEAD",
    "N_SEEN",
    "PARTS",
    "RotatedBody",
    "motion_prediction",
    "motion_prediction_8_windows",
    "motion_prediction_corrected",
    "motion_prediction_problem",
]

N_SEEN, N_AHEAD = 10, 25
STEP = 2  # every second row of a file is kept: 60 of 120 frames a second
ACTIONS = tuple(
    dict.fromkeys(key.partition("/")[2].rpartition("_")[0] for key in original_recordings())
)
PARTS = (("Leg", "Foot", "Toe"), ("Arm", "Hand", "Thumb"))
"""Words in the names of joints of the legs and of the arms."""
TRAINING = tuple(f"rotations:{key}" for key in original_recordings() if key.startswith("train/"))
OVER_4_MIB = (
    *("rotations:train/directing_traffic_2", "rotations:train/directing_traffic_3"),
    *(f"rotations:train/washwindow_{number}" for number in (1, 2, 3)),
)
"""Files that some copies of the data lack."""
TRAININGS = {
    "40 files": TRAINING,
    "35 files": tuple(uri for uri in TRAINING if uri not in OVER_4_MIB),
}
SYNTHETIC = ("gait:04_01", ("gait:01_01", "gait:02_01", "gait:03_02"))
"""What is tested, and what is learnt from."""

Starts = NDArray[np.intp]
"""The first frame of each window."""

_SEED, _N_DRAWN, _HISTORY = 1234567890, 8, 50


def _start_everywhere(n_frames: int) -> Starts:
    return np.arange(n_frames - N_SEEN - N_AHEAD + 1)


def _draw_starts(n_frames: int) -> Starts:
    """Return eight starts, as code draws them that looks at fifty frames of history."""
    rng = np.random.RandomState(_SEED)
    drawn = [rng.randint(0, n_frames - _HISTORY - N_AHEAD) for _ in range(_N_DRAWN)]
    return np.array(drawn) + _HISTORY - N_SEEN


MANNERS: Mapping[str, tuple[Callable[[int], Starts], int, float]] = {
    "motion-prediction": (_start_everywhere, 0, 7.0),
    "motion-prediction-8-windows": (_draw_starts, 0, 7.0),
    "motion-prediction-corrected": (
        _start_everywhere,
        1,  # without the rest pose, which is no motion
        rotation_skeleton().centimetres_per_unit,
    ),
}
"""By task, where windows start, the first frame kept, and centimetres in the unit of bones."""


class RotatedBody:
    """A body whose recordings hold the coordinates of the joints that are left to predict.

    Parameters
    ----------
    centimetres : float
        In the unit of the skeleton's bones: 5.64, or 7 as contests have it.
    """

    skeleton: Skeleton = rotation_skeleton()

    def __init__(self, centimetres: float) -> None:
        self.centimetres = centimetres

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return all 38 joints (N, 38, 3) of complete frames, in these centimetres."""
        values = np.concatenate([recording.values for recording in recordings])
        predicted = values.reshape(len(values), len(PREDICTED), 3) / self.centimetres
        return complete_joints(predicted) * self.centimetres

    def dependence(self, channels: Sequence[str]) -> JointByChannel:
        """Return True where the channel is a coordinate of the joint or one that coincides."""
        owners = [channel.partition(".")[0] for channel in channels]
        shown_by = [PREDICTED[joint] if joint >= 0 else "" for joint in coincident_joints()]
        return np.array([[owner == name for owner in owners] for name in shown_by])


def motion_prediction_problem(
    seeds: Seeds, archive: Archive, *, manner: str, tested: str, training: tuple[str, ...]
) -> ImputeProblem:
    """Hide the last 25 of 35 frames in each window of a recording.

    Parameters
    ----------
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`. Nothing is drawn from the seeds: the contest
        has its own.
    manner : str
        A key of `MANNERS`.
    tested, training : str, tuple of str
        Addresses of recordings.

    Raises
    ------
    ValueError
        If a recording is shorter than a window.
    """
    del seeds
    start_windows, first, centimetres = MANNERS[manner]
    recording = _read(archive, tested, first, centimetres)
    windows = _cut_windows(recording, start_windows(len(recording.times)))
    hidden = np.arange(N_SEEN + N_AHEAD)[:, None] >= N_SEEN
    return ImputeProblem(
        train=tuple(_read(archive, uri, first, centimetres) for uri in training),
        given=tuple(window.hide(hidden) for window in windows),
        truth=tuple(window.values for window in windows),
        unit=Unit.natural(len(recording.channels)),
        body=RotatedBody(centimetres),
    )


def _cut_windows(recording: Recording, starts: Starts) -> list[Recording]:
    frames = np.arange(N_SEEN + N_AHEAD)
    return [
        replace(recording.frames(start + frames), name=f"{recording.name} from {start + 1}")
        for start in starts
    ]


def _read(archive: Archive, uri: str, first: int, centimetres: float) -> Recording:
    """Return the coordinates (N, 75) of the predicted joints at every second frame."""
    rotations = _read_rotations(archive, uri)
    kept = np.arange(len(rotations.times))[::STEP][first:]
    if len(kept) < N_SEEN + N_AHEAD:
        raise ValueError(
            f"{uri}: expected {N_SEEN + N_AHEAD} frames or more at every second row, got "
            f"{len(kept)}; copy the file anew"
        )
    joints = place_rotated_joints(rotations.values[kept]) * centimetres
    names = [segment.name for segment in RotatedBody.skeleton.segments]
    columns = [names.index(name) for name in PREDICTED]
    channels = tuple(f"{name}.{axis}" for name in PREDICTED for axis in "xyz")
    values = joints[:, columns].reshape(len(kept), -1)
    return Recording(uri, rotations.times[kept], values, channels, ("cm",) * len(channels))


def _read_rotations(archive: Archive, uri: str) -> Recording:
    """Return rotation vectors, made from joint angles where the recording has these."""
    recording = archive.recording(uri)
    if uri.startswith("rotations:"):
        return recording
    return rotations_of(recording, archive.skeleton(uri))


def _build_case(manner: str, action: str, training: str) -> Case:
    tested = f"rotations:test/{action}_1"
    problem = partial(
        motion_prediction_problem, manner=manner, tested=tested, training=TRAININGS[training]
    )
    return Case(
        f"{action.replace('_', '-')} {training}",
        problem,
        {"action": action.replace("_", " "), "training": training},
        (tested, *TRAININGS[training]),
        training=training,
    )


def _build_synthetic_case(manner: str) -> Case:
    tested, training = SYNTHETIC
    problem = partial(motion_prediction_problem, manner=manner, tested=tested, training=training)
    columns = {"action": "gait", "training": "three generated walkers"}
    return Case("synthetic gait", problem, columns, (tested, *training), synthetic=True)


_OTHERS = (
    *("aligned-window", "best-of", "channel-kriging", "cubic-spline", "cyclic-alignment", "fam"),
    *("gpdm", "gplvm", "knn", "linear", "low-rank", "makima", "nn", "pca-regression", "pchip"),
    *("pose-kriging", "pose-viterbi", "trivial"),
)
"""They fill each of thousands of windows anew, in hours, or hold as ``zero-velocity`` does."""


def _build_task(name: str, page: TaskPage) -> Task:
    cases = (
        *(_build_case(name, action, training) for training in TRAININGS for action in ACTIONS),
        _build_synthetic_case(name),
    )
    (*_, synthetic) = names = [case.name for case in cases]
    return Task(
        name=name,
        version=1,
        page=page,
        requires={"continues recordings", "fills new recordings"},
        cases=cases,
        entrants=(
            Entrant("zero-velocity", "hold"),
            Entrant("gp-forecast", "gp-forecast", {"parts": PARTS, "max_windows": 12000}),
        ),
        profiles={
            "smoke": Profile((synthetic,), 1, {"max_iter": 2}, (*_OTHERS, "lds")),
            "paper": Profile(tuple(names[: len(ACTIONS)]), 1, {}, _OTHERS),
        },
        max_folds=1,
        independent_folds=False,
    )


motion_prediction: Task = _build_task("motion-prediction", ALL_WINDOWS)
motion_prediction_8_windows: Task = _build_task("motion-prediction-8-windows", EIGHT_WINDOWS)
motion_prediction_corrected: Task = _build_task("motion-prediction-corrected", CORRECTED)
