"""The body of subject 35's task, whose values are scaled and folded joint angles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.datasets import (
    FrameByJointBy3,
    Recording,
    taylor_deviations,
    taylor_scales,
)

__all__ = ["ScaledAngles", "scaled_angles"]


class ScaledAngles(JointAngles):
    """A body on the spot, from `taylor_features`, which say neither where it is nor its heading."""

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return the joints of complete frames; see `Body.positions`."""
        return super().positions(*map(_angles_of, recordings))


def _angles_of(recording: Recording) -> Recording:
    """Return the joint angles in degrees of a recording of scaled and folded ones."""
    deviations = np.array([taylor_deviations()[name] for name in recording.channels])
    values = dict(zip(recording.channels, (recording.values * deviations).T, strict=True))
    turned = {
        f"root.{axis}": np.arctan2(values[f"root.{axis}.sin"], values[f"root.{axis}.cos"])
        for axis in ("rx", "rz")
    }
    radians = {name: values[name] for name in taylor_scales()} | turned
    degrees = np.rad2deg(np.column_stack([*radians.values()]))
    columns = np.column_stack([values["root.ty"], degrees])
    channels = ("root.ty", *radians)
    return replace(recording, values=columns, channels=channels, units=("",) * len(channels))


def scaled_angles(solved: Solved[ImputeProblem, Predictions]) -> ScaledAngles | None:
    """Return the body of the recording to fill, None where no skeleton is at hand."""
    if solved.archive is None:
        return None
    return ScaledAngles(solved.archive.skeleton(solved.problem.given[0].name))
