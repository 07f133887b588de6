"""The exact Gaussian-process core.

A model of recordings (`reduction`) becomes a few small Gaussian problems of one form (`block`),
which interchangeable exact solvers (`solver`: `dense`, `latent_split`, `state_space`) evaluate,
differentiate and condition. On top of it stand training by maximum likelihood (`start`,
`training`), prediction and draws (`prediction`, `sampling`), and the base class of the models
(`estimator`). ``docs/inference.md`` has the mathematics in the names used here.
"""

from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.prior.kernels import KERNELS, Kernel
from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT, Layer, Parameters
from mocapbench.baselines.gp.solvers.solver import Posterior, SingularCovarianceError, Solver

__all__ = [
    "CHILD",
    "KERNELS",
    "PARENT",
    "GaussianProcess",
    "Kernel",
    "Layer",
    "Parameters",
    "Posterior",
    "SingularCovarianceError",
    "Solver",
]
