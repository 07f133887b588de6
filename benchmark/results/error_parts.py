"""From the parts of records to errors along gaps and by joint."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.record import Record
from mocapbench.datasets import Archive, FormatError, Recording, RecordingUnavailable
from mocapbench.datasets.kinematics import joint_positions
from mocapbench.metrics.entries import mean_over
from mocapbench.reports import ErrorParts

__all__ = ["N_PLACES", "along_gap", "error_parts"]

N_PLACES = 20
"""Places along a gap."""
SHORTEST = 8
"""Frames; shorter gaps have no course to speak of."""
OF_JOINTS = "mpjpe"

Array = NDArray[np.float32]
Cell = tuple[str, str, str]


def error_parts(records: Sequence[Record], archive: Archive) -> ErrorParts:
    """Return the errors along gaps and by joint that ``records`` hold.

    Parameters
    ----------
    records : sequence of Record
    archive : Archive
        For the bodies; a task whose skeleton is not here has none.
    """
    metrics = _metrics(records)
    gaps: dict[Cell, list[Array]] = defaultdict(list)
    joints: dict[Cell, list[Array]] = defaultdict(list)
    for record in records:
        cell = (record.address.task, record.address.case, record.address.label)
        frames = record.parts.get(metrics.get(record.address.task, ""), {}).get("frame", [])
        gaps[cell].extend(along_gap(np.array(frames, dtype=np.float64)))
        if of_joints := record.parts.get(OF_JOINTS, {}).get("joint"):
            joints[cell].append(np.array(of_joints, dtype=np.float32))
    return ErrorParts(
        metrics,
        {cell: np.stack(windows) for cell, windows in gaps.items() if windows},
        {cell: _mean(folds) for cell, folds in joints.items()},
        _rest_poses([record for record in records if OF_JOINTS in record.parts], archive),
    )


def along_gap(errors: NDArray[np.float64]) -> list[Array]:
    """Return the errors at even places along each long gap with visible frames at both ends.

    Parameters
    ----------
    errors : ndarray of shape (N,)
        By frame, NaN where nothing is hidden.

    Returns
    -------
    list of ndarray of shape (20,)
    """
    places = (np.arange(N_PLACES) + 0.5) / N_PLACES
    return [
        np.interp(
            places, (np.arange(last - first) + 0.5) / (last - first), errors[first:last]
        ).astype(np.float32)
        for first, last in run_bounds(np.isfinite(errors)).tolist()
        if last - first >= SHORTEST and first > 0 and last < len(errors)
    ]


def _metrics(records: Sequence[Record]) -> dict[str, str]:
    """Return, by task, the first metric of its page whose scores have parts by frame."""
    with_frames: dict[str, set[str]] = defaultdict(set)
    for record in records:
        with_frames[record.address.task] |= {m for m, p in record.parts.items() if "frame" in p}
    pages = {task: TASKS.get(task).page.metrics for task in with_frames}
    chosen = {task: [m for m in page if m in with_frames[task]] for task, page in pages.items()}
    return {task: names[0] for task, names in chosen.items() if names}


def _mean(folds: Sequence[Array]) -> Array:
    """Return the mean over folds of what each has; NaN where none has anything."""
    stacked = np.stack(folds).astype(np.float64)
    return mean_over(stacked, np.isfinite(stacked), axis=0).astype(np.float32)


def _rest_poses(records: Sequence[Record], archive: Archive) -> dict[str, pd.DataFrame]:
    """Return the body of each task, of the first recording whose skeleton has as many joints."""
    poses: dict[str, pd.DataFrame] = {}
    for record in records:
        task, case = record.address.task, record.address.case
        if task not in poses:
            n_joints = len(record.parts[OF_JOINTS]["joint"])
            found = (_rest_pose(uri, archive) for uri in TASKS.get(task).case(case).recordings)
            pose = next((p for p in found if p is not None and len(p) == n_joints), None)
            poses |= {task: pose} if pose is not None else {}
    return poses


def _rest_pose(uri: str, archive: Archive) -> pd.DataFrame | None:
    try:
        skeleton = archive.skeleton(uri)
    except (RecordingUnavailable, FormatError):
        return None
    still = Recording("rest", np.zeros(1), np.zeros((1, 0)), (), ())
    names = [segment.name for segment in skeleton.segments]
    pose = pd.DataFrame(joint_positions(skeleton, still)[0], names, ["x", "y", "z"])
    return pose.assign(parent=skeleton.parents)
