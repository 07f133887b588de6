r"""The contract of exact inference.

A solver knows one way to compute, for a `Block` with covariance :math:`K(\theta)` and data
:math:`z_r`,

* `Solver.evaluate`: the log-density and its gradient in :math:`\theta`. With
  :math:`\alpha_r = K^{-1} z_r` the gradient is :math:`\langle \bar K, \partial K\rangle`,
  :math:`\bar K = \tfrac12 \big(\sum_r \alpha_r \alpha_r^\top - \rho K^{-1}\big)` (thesis eq. 25);
* `Solver.condition`: the posterior of any `Target` at any times, with mean
  :math:`K_* K^{-1} z_r` and variance
  :math:`\tfrac{\rho}{h}\operatorname{diag}(K_{**} - K_* K^{-1} K_*^\top)`.

All solvers are exact: they differ in cost alone, which `Solver.work` predicts.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.threads import Mapper
from mocapbench.baselines.gp.prior.kernels import Kernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target

__all__ = ["Posterior", "SingularCovarianceError", "Solver"]

Array = NDArray[np.float64]


class SingularCovarianceError(np.linalg.LinAlgError):
    """A covariance matrix is not numerically positive definite."""

    def __init__(self, parameters: Parameters) -> None:
        super().__init__(
            "expected a positive definite covariance, but its Cholesky factorisation failed at "
            f"{parameters}. The noise is too small for kernels this smooth or variances this "
            "large: raise the noise variance or shorten the lengthscales"
        )


class Posterior(ABC):
    """A block's distribution given its data."""

    @abstractmethod
    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        """Return the posterior of ``target`` at ``times`` (M,), noise left out.

        Returns
        -------
        mean : ndarray of shape (h, D, M)
            One for each data vector.
        variance : ndarray of shape (D, M)
            The same for each data vector.
        """


class Solver(ABC):
    """A way to do exact inference in a block.

    Parameters
    ----------
    kernel : Kernel
        The kernel of every component.
    mapper : callable, default=map
        Calls a function for every output, like the builtin, possibly in threads (`workers`).
    """

    name: ClassVar[str]
    needs: ClassVar[str] = "nothing but memory"
    """What a block must have for the solver to serve it."""

    def __init__(self, kernel: Kernel, mapper: Mapper = map) -> None:
        self.kernel = kernel
        self.mapper = mapper

    @abstractmethod
    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient.

        Raises
        ------
        SingularCovarianceError
            If the covariance is not numerically positive definite.
        """

    @abstractmethod
    def condition(self, block: Block, parameters: Parameters) -> Posterior:
        """Return the posterior given the block's data.

        Raises
        ------
        SingularCovarianceError
            If the covariance is not numerically positive definite.
        """

    @abstractmethod
    def work(self, block: Block, parameters: Parameters) -> float:
        """Return the cost of `evaluate`, roughly, and infinity for a block it cannot serve.

        The unit is an operation of a small factorisation, of which a core does some 1.5e10 a
        second; large matrix products, which run faster, count for less.
        """
