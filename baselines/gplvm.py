"""The Gaussian process latent variable model: GPDM without dynamics."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mocapbench.baselines.gpdm.dynamics import Dynamics, Static
from mocapbench.baselines.gpdm.latent_variable_model import LatentVariableModel
from mocapbench.baselines.gpdm.learning import Learning, MaximumAPosteriori

__all__ = ["GPLVM"]


class GPLVM(LatentVariableModel):
    r"""Poses as smooth functions of latent positions that are independent of each other.

    It is `GPDM` without dynamics: the positions are independent standard normal, and hidden frames
    are filled in the same way.

    Parameters
    ----------
    n_latent : int, default=3
        Number of latent dimensions; the rank of the data, if that is smaller.
    start : {"linear", "mean-prediction", "window", "viterbi"}, default="linear"
        Initial latent trajectory of a sequence to fill.
    subject_offset : float, default=0.0
        The fraction, from 0 to 1, of the mean residual of `PoseViterbi` at the visible frames that
        is subtracted before filling and added afterwards.
    max_iter : int, default=100
        Rounds of learning.
    n_steps : int, default=10
        Iterations of L-BFGS in a round.
    fill_iter : int, default=100
        Iterations of L-BFGS on the trajectory of a sequence to fill.
    random_state : int, numpy.random.Generator or None, default=None
        Not used; the estimator is deterministic.

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
        Signal-to-noise ratio and characteristic lengthscale of the mapping to poses.
    matcher_ : PoseViterbi
        The model from which the subject's offset is computed.
    frame_seconds_ : float
        The time between training frames.

    Notes
    -----
    With one Gaussian process for each channel j, its scale :math:`w_j`, and the latent position
    :math:`x_t` of frame t:

    .. math::

        y_{tj} = \frac{g_j(x_t) + n_{tj}}{w_j}, \qquad
        g_j + n_j \sim \mathcal{GP}\bigl(0, e^{-\frac{\beta_1}{2} \| x - x' \|^2}
        + \beta_2^{-1} \delta\bigr), \qquad x_t \sim N(0, I)

    ``docs/mathematics/gpdm.md`` has the learning and the filling.

    References
    ----------
    N. D. Lawrence (2005), Probabilistic Non-linear Principal Component Analysis with Gaussian
    Process Latent Variable Models, JMLR 6.

    J. M. Wang, D. J. Fleet and A. Hertzmann (2008), Gaussian Process Dynamical Models for Human
    Motion, IEEE TPAMI 30(2),
    Figs. 3b and 5a.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import GPLVM
    >>> from mocapbench.datasets import Recording
    >>> angle = 2 * np.pi * np.arange(20) / 10
    >>> values = np.column_stack([np.sin(angle), np.cos(angle)])
    >>> walk = Recording("walk", np.arange(20) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> model = GPLVM(n_latent=2, max_iter=2).fit([walk])
    >>> model.latent_paths()[0].shape, model.poses(np.zeros((1, 2))).shape
    ((20, 2), (1, 2))
    """

    max_frames: ClassVar[int | None] = 300

    def __init__(
        self,
        *,
        n_latent: int = 3,
        start: str = "linear",
        subject_offset: float = 0.0,
        max_iter: int = 100,
        n_steps: int = 10,
        fill_iter: int = 100,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_latent = n_latent
        self.start = start
        self.subject_offset = subject_offset
        self.max_iter = max_iter
        self.n_steps = n_steps
        self.fill_iter = fill_iter
        self.random_state = random_state

    def _dynamics(self) -> Dynamics:
        return Static()

    def _learning(self) -> Learning:
        return MaximumAPosteriori(self.max_iter, self.n_steps)
