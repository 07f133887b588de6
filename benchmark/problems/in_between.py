"""In-betweening scored as its papers do: by rotations in space, and by normalised positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.problems.body import JointByChannel
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.benchmark.problems.placement import imputed_poses
from mocapbench.datasets import FrameByChannel, FrameByJointBy3, Recording, Skeleton
from mocapbench.datasets.lafan1.unit_quaternions import place_joints
from mocapbench.datasets.lafan1.windows import Take, offsets_of
from mocapbench.metrics import Imputation, ImputedPoses
from mocapbench.metrics.entries import mean_over, variance_over
from mocapbench.metrics.in_betweening import QUATERNION

__all__ = ["InBetweenProblem", "QuaternionBody", "rotation_channels"]

N_PATH = 3  # the coordinates of the root come before the quaternions


def rotation_channels(skeleton: Skeleton) -> tuple[str, ...]:
    """Return the root's coordinates, and the four numbers of each joint's rotation."""
    joints = [segment.name for segment in skeleton.segments]
    path = (f"{joints[0]}.t{axis}" for axis in "xyz")
    return (*path, *(f"{joint}.q{part}" for joint in joints for part in "wxyz"))


class QuaternionBody:
    """A body whose recordings hold the root's place and a quaternion for each joint.

    Parameters
    ----------
    skeleton : Skeleton
        Of J joints, whose offsets turn with their parents.
    spread : ndarray of shape (J, 3)
        Standard deviations of the coordinates in training, in centimetres.
    """

    def __init__(self, skeleton: Skeleton, spread: FrameByJointBy3) -> None:
        self.skeleton: Skeleton = skeleton
        self.spread: FrameByJointBy3 = spread

    def place(self, values: FrameByChannel) -> Take:
        """Return the rotations in space (N, J, 4) and the joints in cm (N, J, 3) of frames.

        Parameters
        ----------
        values : ndarray of shape (N, 3 + 4 J)
            Quaternions are divided by their length, or stand for no rotation where that is zero.
        """
        path, numbers = values[:, :N_PATH], values[:, N_PATH:].reshape(len(values), -1, 4)
        lengths = np.linalg.norm(numbers, axis=2, keepdims=True)
        own = np.where(lengths, numbers / np.where(lengths, lengths, 1.0), [1.0, 0.0, 0.0, 0.0])
        offsets = offsets_of(self.skeleton) * self.skeleton.centimetres_per_unit
        return place_joints(path, own, offsets, self.skeleton.parents)

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return the joints of complete frames; see `mocapbench.benchmark.problems.body.Body`."""
        _, joints = self.place(np.concatenate([recording.values for recording in recordings]))
        return joints

    def dependence(self, channels: Sequence[str]) -> JointByChannel:
        """Return True where the channel is of the root's path, or of a joint that carries this."""
        names = [segment.name for segment in self.skeleton.segments]
        rotates = np.array([[c.startswith(f"{name}.q") for c in channels] for name in names])
        depends = np.zeros_like(rotates)
        depends[0] = [".t" in channel for channel in channels]
        for joint, parent in enumerate(self.skeleton.parents[1:], start=1):
            depends[joint] = depends[parent] | rotates[parent]
        return depends


class InBetweenProblem(ImputeProblem):
    """Fill the hidden frames of recordings of a `QuaternionBody`.

    Models see rotations of joints within their parents; scores are of rotations in space, which
    have no variance, and of positions.
    """

    body: QuaternionBody

    def outcome(self, solution: Predictions) -> Imputation:
        """Put the rotations in space of all recordings one below the other."""
        known = [recording.visible for recording in self.given]
        pairs = zip(known, self.truth, solution, strict=True)
        filled = [np.where(visible, values, p.mean) for visible, values, p in pairs]
        truth, mean = self._list_rotations(self.truth), self._list_rotations(filled)
        whole = np.concatenate(known).all(axis=1, keepdims=True)
        seen = np.repeat(whole, truth.shape[1], axis=1)
        return Imputation(
            truth=truth,
            mean=mean,
            variance=None,
            hidden=~seen,
            visible_mean=np.nan_to_num(mean_over(truth, seen, axis=0)),
            visible_variance=np.nan_to_num(variance_over(truth, seen)),
            units=(QUATERNION,) * truth.shape[1],
            place_joints=self._placement(solution),
        )

    def _list_rotations(self, values: Sequence[FrameByChannel]) -> Array:
        """Return the rotations in space (N, 4 J) of all frames."""
        rotations, _ = self.body.place(np.concatenate(values))
        return rotations.reshape(len(rotations), -1)

    def _placement(self, solution: Predictions) -> Callable[[], ImputedPoses]:
        return partial(_place_with_spread, self, solution)


def _place_with_spread(problem: InBetweenProblem, solution: Predictions) -> ImputedPoses:
    body = problem.body
    poses = imputed_poses(body, problem.given, problem.truth, solution)
    return replace(poses, spread=body.spread)
