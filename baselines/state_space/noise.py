"""The noise that visible entries show, without the prior that keeps it from vanishing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mocapbench.baselines.state_space.model import StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.prediction import moments
from mocapbench.baselines.state_space.regression import Prior, Regression
from mocapbench.baselines.state_space.smoothing import smooth_states

__all__ = ["NoiseShown", "with_noise_shown"]

_PRIOR = Prior(frames=1.0, variance=1e-2, ridge=0.0)
"""One frame: a channel of which little is visible keeps some noise."""
_ITERATIONS = 5


def with_noise_shown(parameters: StateSpaceParameters, data: Observations) -> StateSpaceParameters:
    """Return the parameters with the noise of each channel as its visible entries show it.

    These are a few iterations of EM in which all else is kept.
    """
    for _ in range(_ITERATIONS):
        mean, variance = moments(parameters, smooth_states(parameters, data))
        squares = (data.values - mean) ** 2 + variance - parameters.noise
        sums = np.where(data.visible, squares, 0.0).sum(axis=(0, 1))
        counts = data.visible.sum(axis=(0, 1)) + _PRIOR.frames
        noise = (sums + _PRIOR.frames * _PRIOR.variance) / counts
        emission = Regression(parameters.emission.coefficients, noise[:, None, None])
        parameters = replace(parameters, emission=emission)
    return parameters


@dataclass(frozen=True, eq=False)
class NoiseShown:
    """The noise that the data show which parameters were learnt from, found when it is asked for.

    Parameters
    ----------
    learnt : StateSpaceParameters
    data : Observations
    """

    learnt: StateSpaceParameters
    data: Observations

    @cached_property
    def shown(self) -> StateSpaceParameters:
        """The parameters with this noise."""
        return with_noise_shown(self.learnt, self.data)
