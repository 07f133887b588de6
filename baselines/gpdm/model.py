"""The Gaussian process dynamical model of Wang, Fleet and Hertzmann (2008), cited as GPDM."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar

import numpy as np

from mocapbench.baselines.common.validation import check_choice, check_count
from mocapbench.baselines.gpdm.dynamics import Dynamics, Markov
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.kernels import (
    LatentKernel,
    LinearKernel,
    RBFKernel,
    ScaledKernel,
    SumKernel,
)
from mocapbench.baselines.gpdm.learning import (
    Balanced,
    FixedDynamics,
    Learning,
    MaximumAPosteriori,
)
from mocapbench.baselines.gpdm.synthesis import DynamicalModel
from mocapbench.baselines.gpdm.two_stage import TwoStage

__all__ = ["GPDM"]

_KERNELS: Mapping[str, Callable[[int], LatentKernel]] = {
    "linear+rbf": lambda order: SumKernel(ScaledKernel(RBFKernel(order)), LinearKernel(order)),
    "rbf": lambda order: ScaledKernel(RBFKernel(order)),
    "linear": LinearKernel,
}
_CARRY = {"position": 0.0, "velocity": 1.0}
_POSITION_STEP = 3e-3


class GPDM(DynamicalModel):
    r"""Poses and their dynamics as smooth functions of a path through a latent space.

    Poses are :math:`y_t = W^{-1}(g(x_t) + n_{y,t})` and latent positions :math:`x_t =
    f(x_{t-1}) + n_{x,t}`, with both functions integrated out under Gaussian-process priors. To
    fill a sequence, its latent trajectory is optimised from ``start``. Hidden frames take their
    mean given the training sequences and the visible frames at this trajectory. The variance is
    that of an observation at this trajectory; it does not include the trajectory's uncertainty.

    Channels that are constant in training are left out with a warning. They are filled with their
    constant value and the variance σ_Y²(x)/(κ² N), where σ_Y²(x) is that of a scaled channel at the
    latent position x, and 1/(κ² N) the bound that the prior of the scales implies on its unit,
    squared. Where channels have several units, degrees and radians count as degrees, and mm, cm and
    m as the CMU database's unit of length, 5.64 cm; if all have the same one, that prior is in it.
    Time is counted in frames, so that all recordings
    need the same frame rate: `fit` refuses rates that differ by more than 1 %.

    Parameters
    ----------
    learning : {"map", "balanced", "fixed-alpha", "two-stage"}, default="balanced"
        The learning algorithm: GPDM §4.1, §4.2, §4.3 and §4.4.
    n_latent : int, default=3
        Number of latent dimensions; the rank of the data, if that is smaller.
    dynamics : {"linear+rbf", "rbf", "linear"}, default="linear+rbf"
        Kernel of the dynamics, GPDM eq. (12) and (11).
    order : {1, 2}, default=1
        Number of previous positions on which the next one depends, GPDM eq. (17).
    predicts : {"position", "velocity"}, default="position"
        Whether the dynamics predict the next position or the step to it, GPDM eq. (19).
    start : {"linear", "mean-prediction", "window", "viterbi"}, default="viterbi"
        Initial latent trajectory of a sequence to fill: linear between the nearest training
        positions, the mean of the dynamics, the nearest training window, or the most probable path
        through the training positions.
    subject_offset : float, default=0.0
        The fraction, from 0 to 1, of the mean residual of `PoseViterbi` at the visible frames that
        is subtracted before filling and added afterwards.
    max_iter : int, default=100
        Rounds of learning (the paper's I); two-stage learning has a tenth as many.
    n_steps : int, default=10
        Iterations of L-BFGS in a round (the paper's J). Both numbers are early stopping: the kernel
        parameters drift for thousands of iterations.
    fill_iter : int, default=100
        Iterations of L-BFGS on the trajectory of a sequence to fill.
    n_samples : int, default=50
        Samples of the latent positions in a round of two-stage learning (the paper's R).
    random_state : int, numpy.random.Generator or None, default=None
        Seed of two-stage learning.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    sequences_ : TrainingSequences
        The training frames. Where channels have several units, they are in degrees and the CMU
        database's unit of length, 5.64 cm, not in radians, mm, cm or m.
    estimate_ : PointEstimate
        Latent positions and parameters; the scales W are in the reciprocals of these units.
    conditional_ : Conditional
        The distribution of a further sequence.
    kernel_properties_ : dict of str to float
        Signal-to-noise ratio and characteristic lengthscale of both kernels: GPDM Table 1.
    matcher_ : PoseViterbi
        The model from which the subject's offset is computed.
    frame_seconds_ : float
        The time between training frames.

    Notes
    -----
    With the default dynamics, the kernels of the poses and of the dynamics are

    .. math::

        k_Y(x, x') = e^{-\frac{\beta_1}{2} \| x - x' \|^2} + \beta_2^{-1} \delta

    .. math::

        k_X(x, x') = \alpha_1 e^{-\frac{\alpha_2}{2} \| x - x' \|^2} + \alpha_3 x^\top x'
        + \alpha_4^{-1} \delta

    ``docs/mathematics/gpdm.md`` has the learning and the filling.

    References
    ----------
    J. M. Wang, D. J. Fleet and A. Hertzmann (2008), Gaussian Process Dynamical Models for Human
    Motion, IEEE TPAMI 30(2): the model §3, learning §4, synthesis and filling §5.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import GPDM
    >>> from mocapbench.datasets import Recording
    >>> angle = 2 * np.pi * np.arange(25) / 12
    >>> values = np.column_stack([np.sin(angle), np.cos(angle)])
    >>> walk = Recording("walk", np.arange(25) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> model = GPDM(n_latent=2, max_iter=2, fill_iter=5).fit([walk])
    >>> gap = np.zeros((25, 2), dtype=bool)
    >>> gap[10:14] = True
    >>> (prediction,) = model.impute([walk.hide(gap)])
    >>> bool(np.abs(prediction.mean - values).max() < 0.5)
    True
    """

    max_frames: ClassVar[int | None] = 300

    def __init__(
        self,
        learning: str = "balanced",
        *,
        n_latent: int = 3,
        dynamics: str = "linear+rbf",
        order: int = 1,
        predicts: str = "position",
        start: str = "viterbi",
        subject_offset: float = 0.0,
        max_iter: int = 100,
        n_steps: int = 10,
        fill_iter: int = 100,
        n_samples: int = 50,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.learning = learning
        self.n_latent = n_latent
        self.dynamics = dynamics
        self.order = order
        self.predicts = predicts
        self.start = start
        self.subject_offset = subject_offset
        self.max_iter = max_iter
        self.n_steps = n_steps
        self.fill_iter = fill_iter
        self.n_samples = n_samples
        self.random_state = random_state

    def _check_parameters(self) -> None:
        super()._check_parameters()
        check_count("n_samples", self.n_samples, 1)
        check_choice("learning", self.learning, self._learnings())
        check_choice("dynamics", self.dynamics, _KERNELS)
        check_choice("predicts", self.predicts, _CARRY)
        if self.order not in (1, 2):
            raise ValueError(f"expected order to be 1 or 2, got {self.order!r}")

    def _dynamics(self) -> Dynamics:
        kernel = _KERNELS[self.dynamics](self.order)
        return Markov(kernel, self.order, _CARRY[self.predicts])

    def _learning(self) -> Learning:
        return self._learnings()[self.learning]

    def _learnings(self) -> Mapping[str, Learning]:
        rounds, steps = self.max_iter, self.n_steps
        sampler = HybridMonteCarlo(self.n_samples, n_burn=10, n_leaps=100, step=_POSITION_STEP)
        return {
            "map": MaximumAPosteriori(rounds, steps),
            "balanced": Balanced(rounds, steps),
            "fixed-alpha": FixedDynamics(rounds, steps),
            "two-stage": TwoStage(sampler, max(rounds // 10, 1), steps, steps, rounds * steps),
        }
