"""The Gaussian process latent variable model: GPDM without dynamics."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gpdm.dynamics import Dynamics, Static
from mocapbench.baselines.gpdm.estimator import LatentVariableModel
from mocapbench.baselines.gpdm.learning import Learning, MaximumAPosteriori

__all__ = ["GPLVM"]


class GPLVM(LatentVariableModel):
    """Poses as smooth functions of latent positions that are independent of each other.

    What `GPDM` would be if it knew no time: hidden frames are filled in the same way.

    Parameters
    ----------
    n_latent, start, subject_offset, max_iter, n_steps, fill_iter, random_state
        As of `GPDM`; the default start is ``"linear"``, since no dynamics lead through a gap.

    Attributes
    ----------
    channels_, sequences_, estimate_, conditional_, kernel_properties_, matcher_, frame_seconds_
        As of `GPDM`.

    References
    ----------
    N. D. Lawrence (2005), Probabilistic Non-linear Principal Component Analysis with Gaussian
    Process Latent Variable Models, JMLR 6; GPDM Figs. 3b and 5a.
    """

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
