"""Negative control: samples of an unrelated process.

A similarity measure is meaningful only if samples of a process that generated none of the
recordings score worse than samples of a fitted model: §A.4.1 of J. D. Gil López, *Hierarchical
Multiple Output Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de
Pereira, 2017.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_outputs, check_recordings
from mocapbench.baselines.common.validation import check_sampling
from mocapbench.baselines.protocols import SampleByFrameByChannel, Synthesiser
from mocapbench.datasets import Frames, Recording, ToyProcess
from mocapbench.datasets.process import draw_gaussian

__all__ = ["Control"]


class Control(Synthesiser):
    r"""Draw recordings of an unrelated process, which a useful synthesiser must surpass.

    Attributes
    ----------
    process_ : ToyProcess
        The process given to `fit`.

    Notes
    -----
    Every sample is a child of a parent of its own, of the unrelated process with the covariances
    :math:`K_g` of the parent and :math:`K_f` of children around it:

    .. math:: x_s \sim N(0, K_g + K_f + \sigma^2 I)

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §A.4.1.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import Control
    >>> from mocapbench.datasets import ToyProcess
    >>> process, unrelated = (
    ...     ToyProcess.random(np.random.default_rng(seed), n_outputs=2, noise=0.01)
    ...     for seed in (0, 1)
    ... )
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(np.random.default_rng(2), times, 3)
    >>> Control().fit(children, unrelated).sample(times, 4, random_state=0).shape
    (4, 20, 2)
    """

    family: ClassVar[str] = "References"
    needs: ClassVar[frozenset[str]] = frozenset({"unrelated process"})

    def fit(self, recordings: Sequence[Recording], unrelated: ToyProcess | None = None) -> Self:
        """Check the recordings; nothing is learnt from them.

        Parameters
        ----------
        recordings : sequence of Recording
        unrelated : ToyProcess
            A process that generated none of them.

        Raises
        ------
        ValueError
            If no process is known, or the recordings' channels differ or are not its outputs.
        """
        if unrelated is None:
            raise ValueError("expected a process that generated none of the recordings, got None")
        self.process_ = unrelated
        check_outputs(check_recordings(recordings), self.process_)
        return self

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return ``n_samples`` recordings of as many parents, noise included: (n, N, D).

        ``times`` (N,) may be in any order.

        Raises
        ------
        ValueError
            If times, the number of samples or the seed are invalid.
        """
        check_is_fitted(self, "process_")
        times = check_sampling(times, n_samples, random_state, increasing=False)
        rng = np.random.default_rng(random_state)
        curves = draw_gaussian(rng, self.process_.covariance(times), n_samples)
        return curves.reshape(n_samples, self.process_.n_outputs, -1).transpose(0, 2, 1)
