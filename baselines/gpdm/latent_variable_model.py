"""The common estimator of the GPDM family: fitting and filling with any prior and learning.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.pose_units import in_pose_units, pose_factors
from mocapbench.baselines.common.recordings import by_content, visible_frames
from mocapbench.baselines.common.validation import (
    check_choice,
    check_count,
    check_seed,
    check_share,
)
from mocapbench.baselines.gpdm.conditional import Conditional
from mocapbench.baselines.gpdm.dynamics import Dynamics
from mocapbench.baselines.gpdm.kernels import RBFKernel
from mocapbench.baselines.gpdm.learning import Learning
from mocapbench.baselines.gpdm.posterior import KAPPA, JointPosterior, PointEstimate
from mocapbench.baselines.gpdm.regression import log_start, signal_to_noise
from mocapbench.baselines.gpdm.sequences import TrainingSequences, whitened_components
from mocapbench.baselines.gpdm.starts import STARTS
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.baselines.protocols import Embedded, FrameImputer, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["LatentVariableModel"]


class LatentVariableModel(FrameImputer, Inductive, Embedded):
    """Poses as smooth functions of latent positions, which have a prior.

    A subclass provides the prior and the learning algorithm. Its constructor stores ``n_latent``,
    ``start``, ``subject_offset``, ``max_iter``, ``n_steps``, ``fill_iter`` and ``random_state``;
    see `GPDM`.
    """

    family: ClassVar[str] = "Latent dynamics"

    n_latent: int
    start: str
    subject_offset: float
    max_iter: int
    n_steps: int
    fill_iter: int
    random_state: int | np.random.Generator | None

    @abstractmethod
    def _dynamics(self) -> Dynamics:
        """Return the prior of the latent positions."""

    @abstractmethod
    def _learning(self) -> Learning:
        """Return the learning algorithm."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the latent positions of all complete frames, and the parameters.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, no two consecutive frames are complete, no channel moves, or a model with
            dynamics is given frame rates that differ by more than 1 %.
        """
        self._check_parameters()
        dynamics, learning = self._dynamics(), self._learning()
        checked = self._check_recordings(recordings)
        self.recordings_ = checked
        self.sequences_: TrainingSequences = TrainingSequences.of(
            [in_pose_units(each) for each in checked]
        )
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.matcher_: PoseViterbi = PoseViterbi().fit(checked)
        steps = [np.diff(recording.times) for recording in checked if len(recording.times) > 1]
        self.frame_seconds_: float = float(np.median(steps[0]))
        y = self.sequences_.y
        x = whitened_components(y, self.n_latent)
        posterior = JointPosterior(
            RBFKernel(),
            dynamics,
            y,
            self.sequences_.lengths,
            learning.weight(y.shape[1], x.shape[1]),
        )
        start = PointEstimate(
            x, dynamics.start, log_start(posterior.reconstruction), np.ones(y.shape[1])
        )
        rng = np.random.default_rng(self.random_state)
        self.estimate_: PointEstimate = learning.learn(posterior, start, rng)
        self.conditional_: Conditional = Conditional.of(posterior, self.estimate_)
        self.kernel_properties_: dict[str, float] = self._properties(posterior)
        return self

    def _check_recordings(self, recordings: Sequence[Recording]) -> tuple[Recording, ...]:
        """Return the recordings to learn from, after checking them."""
        return by_content(check_recordings(recordings))

    def _check_parameters(self) -> None:
        for name in ("n_latent", "max_iter", "n_steps", "fill_iter"):
            check_count(name, getattr(self, name), 1)
        check_choice("start", self.start, STARTS)
        check_share("subject_offset", self.subject_offset)
        check_seed("random_state", self.random_state)

    def _properties(self, posterior: JointPosterior) -> dict[str, float]:
        """Return SNR and CLS of both kernels, as in GPDM Table 1."""
        estimate, kernel = self.estimate_, posterior.reconstruction
        n_latent = estimate.x.shape[1]
        return {
            **posterior.dynamics.properties(estimate.alpha, n_latent),
            "SNR(β)": signal_to_noise(kernel, estimate.beta, n_latent),
            "CLS(β)": kernel.lengthscales(estimate.beta[:-1])[0],
        }

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the mean and variance of hidden frames given the training and visible frames.

        Variances are those given the most probable latent positions.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, or no frame is visible.
        """
        check_given(self, recordings)
        return [self._fill_recording(recording) for recording in recordings]

    def _fill_recording(self, recording: Recording) -> Prediction:
        visible = visible_frames(recording)
        offset = self.subject_offset * self.matcher_.residual(recording)
        query = self._to_model_units(recording.values - offset), visible
        x = STARTS[self.start](self.conditional_, query)
        x = self.conditional_.optimise(x, query, self.fill_iter)
        mean, variance = self.conditional_.reconstruction.fill_targets(x, *query)
        return Prediction.around(
            recording, self._restore_units(mean) + offset, np.outer(variance, self._units() ** 2)
        )

    def latent_paths(self) -> list[Array]:
        """Return the positions (N_p, d) of each training sequence."""
        check_is_fitted(self)
        return np.split(self.estimate_.x, np.cumsum(self.sequences_.lengths)[:-1])

    def confidence(self, positions: Array) -> Array:
        """Return −ln σ_Y² at ``positions`` (n, d), GPDM eq. (34), noise included."""
        check_is_fitted(self)
        return -np.log(self.conditional_.reconstruction.marginals(positions)[1])

    def poses(self, positions: Array) -> FrameByChannel:
        """Return the mean poses (N, D) at ``positions`` (N, d), GPDM eq. (33)."""
        check_is_fitted(self)
        return self._restore_units(self.conditional_.reconstruction.marginals(positions)[0])

    def _units(self) -> Array:
        """Return the inverse scales (D,) in the channels' units.

        Those of a constant channel are the prior's bound (κ² N)^(−½).
        """
        units = np.full(len(self.channels_), 1.0 / (KAPPA * np.sqrt(len(self.sequences_.y))))
        units[self.sequences_.moving] = 1.0 / self.estimate_.scales
        return units / pose_factors(self.units_)

    def _to_model_units(self, values: FrameByChannel) -> Array:
        """Return the moving channels in the model's units; hidden entries become zero."""
        moving, values = self.sequences_.moving, values * pose_factors(self.units_)
        poses = (values - self.sequences_.mean)[:, moving] * self.estimate_.scales
        return np.nan_to_num(poses, nan=0.0)

    def _restore_units(self, poses: Array) -> FrameByChannel:
        """Return poses (…, D') in the recordings' units and channels: (…, D)."""
        values = np.broadcast_to(self.sequences_.mean, (*poses.shape[:-1], len(self.channels_)))
        values = values.copy()
        values[..., self.sequences_.moving] += poses / self.estimate_.scales
        return np.asarray(values / pose_factors(self.units_))
