"""Expectation–maximisation for one linear Gaussian state-space model."""

from __future__ import annotations

from dataclasses import dataclass

from mocapbench.baselines.state_space.maximisation import maximised
from mocapbench.baselines.state_space.model import Parameters, Priors
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.smoothing import smoothed

__all__ = ["Run", "expectation_maximisation"]


@dataclass(frozen=True)
class Run:
    """The result of EM.

    Parameters
    ----------
    parameters : Parameters
        The final parameters.
    objectives : tuple of float
        Log-likelihood plus log-prior at the start and after each iteration but the last.
    converged : bool
        Whether the last iteration raised the objective by less than the tolerance.
    """

    parameters: Parameters
    objectives: tuple[float, ...]
    converged: bool


def expectation_maximisation(
    parameters: Parameters,
    data: Observations,
    priors: Priors,
    *,
    max_iter: int,
    tolerance: float,
) -> Run:
    """Alternate E-step and M-step, ``max_iter`` times at most.

    Stops when an iteration raises the objective by less than ``tolerance`` per visible entry.
    """
    threshold = tolerance * data.counts.sum()
    objectives: list[float] = []
    for _ in range(max_iter):
        posterior = smoothed(parameters, data)
        objectives.append(float(posterior.log_likelihood.sum()) + parameters.log_prior(priors))
        if len(objectives) > 1 and objectives[-1] - objectives[-2] < threshold:
            return Run(parameters, tuple(objectives), converged=True)
        parameters = maximised(posterior, data, priors)
    return Run(parameters, tuple(objectives), converged=False)
