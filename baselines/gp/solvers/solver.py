r"""What every exact solver computes.

For a `Block` with covariance :math:`K(\theta)` and data vectors :math:`z_r` a solver offers

* `Solver.evaluate`: the log-density and its gradient in :math:`\theta`. With
  :math:`\alpha_r = K^{-1} z_r` the gradient is :math:`\langle \bar K, \partial K\rangle`, where
  :math:`\bar K = \tfrac12 \big(\sum_r \alpha_r \alpha_r^\top - \rho K^{-1}\big)` (eq. 25 of
  J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
  thesis, Universidad Tecnológica de Pereira, 2017);
* `Solver.condition`: the posterior of any `Target` at any times, with mean
  :math:`K_* K^{-1} z_r` and variance
  :math:`\tfrac{\rho}{h}\operatorname{diag}(K_{**} - K_* K^{-1} K_*^\top)`.

All solvers are exact. They differ in cost only, which `Solver.work` estimates.

They do the same small factorisation for every output. A solver takes a *mapper*: the builtin
``map``, or one that distributes the calls over threads. Each result is computed by one thread and
results come in order, so that they do not depend on the number of threads.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import ClassVar, Protocol, TypeVar

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Array

__all__ = [
    "BlockPosterior",
    "Mapper",
    "SingularCovarianceError",
    "Solver",
    "refuse_singular",
    "thread_mapper",
]

T = TypeVar("T")
U = TypeVar("U")


class SingularCovarianceError(np.linalg.LinAlgError):
    """A covariance matrix is not numerically positive definite.

    Parameters
    ----------
    parameters : Parameters
        The point at which the covariance was computed; the message shows it.
    """

    def __init__(self, parameters: Parameters) -> None:
        super().__init__(
            "expected a positive definite covariance, but its Cholesky factorisation failed at "
            f"{parameters}. The noise is too small for kernels this smooth or variances this "
            "large: raise the noise variance or shorten the lengthscales"
        )


@contextmanager
def refuse_singular(parameters: Parameters) -> Iterator[None]:
    """Raise `SingularCovarianceError` where a factorisation inside raises `LinAlgError`."""
    try:
        yield
    except np.linalg.LinAlgError:
        raise SingularCovarianceError(parameters) from None


class Mapper(Protocol):
    """A function with the signature of the builtin ``map`` for one iterable."""

    def __call__(self, function: Callable[[T], U], items: Iterable[T], /) -> Iterable[U]:
        """Return the function of every item, in order."""


@contextmanager
def thread_mapper(n_threads: int) -> Iterator[Mapper]:
    """Give a mapper over ``n_threads`` threads."""
    if n_threads == 1:
        yield map
        return
    with ThreadPoolExecutor(n_threads) as pool:
        yield pool.map


class BlockPosterior(ABC):
    """The distribution of a block's functions given the block's data."""

    @abstractmethod
    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        """Return the posterior of ``target`` at ``times`` (M,), without observation noise.

        Returns
        -------
        mean : ndarray of shape (h, D, M)
            One for each data vector.
        variance : ndarray of shape (D, M)
            The same for each data vector.
        """


class Solver(ABC):
    """One method of exact inference in a block.

    Parameters
    ----------
    kernel : StationaryKernel
        The kernel of every component.
    mapper : callable, default=map
        Calls a function for every output, like the builtin ``map``, possibly in threads
        (`thread_mapper`).
    """

    name: ClassVar[str]
    needs: ClassVar[str] = "nothing but memory"
    """What the solver requires of a block, for error messages."""

    def __init__(self, kernel: StationaryKernel, mapper: Mapper = map) -> None:
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
    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data.

        Raises
        ------
        SingularCovarianceError
            If the covariance is not numerically positive definite.
        """

    @abstractmethod
    def work(self, block: Block, parameters: Parameters) -> float:
        """Return an estimate of the cost of `evaluate`; infinity for a block it cannot solve.

        The unit is one floating-point operation of a small factorisation, of which a processor
        core does about 1.5e10 a second. Large matrix products run faster and count for less.
        """
