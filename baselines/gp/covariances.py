"""What a trained model has learnt: the covariances of its layers and the noise."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import numpy as np
from joblib import effective_n_jobs
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import check_choice, check_times
from mocapbench.baselines.gp.posterior.fitted import FittedProcess
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.gp.threads import thread_mapper
from mocapbench.baselines.protocols import Coregionalised
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames

__all__ = ["LearntCovariances"]


class LearntCovariances(Coregionalised):
    """A Gaussian-process model whose learnt layers and noise can be looked at after `fit`."""

    n_jobs: int | None
    tree_: Tree
    scaling_: Standardisation
    parameters_: Parameters
    _process: FittedProcess

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers of the fitted model, from the trend down, such as ("parent", "child")."""
        check_is_fitted(self, "tree_")
        return tuple(self.tree_)

    @property
    def coregionalisation_(self) -> Mapping[str, Array]:
        """The matrices B_q of each layer by its name, (Q, D, D), in the outputs' own units.

        Entry (d, e) of B_q is in the unit of output d times that of output e.
        """
        check_is_fitted(self, "parameters_")
        units = np.outer(self.scaling_.scale, self.scaling_.scale)
        layers = self.parameters_.layers.items()
        return {name: layer.coregionalisation.matrices * units for name, layer in layers}

    @property
    def noise_(self) -> Array:
        """(D,) noise variance of each output, in the output's squared unit."""
        check_is_fitted(self, "parameters_")
        return self.parameters_.noise * self.scaling_.scale**2

    def covariance(self, layer: str, times: Frames) -> Array:
        """Return the prior covariance Σ_q B_q ⊗ k_q of a layer.

        Parameters
        ----------
        layer : str
            One of `layers`.
        times : ndarray of shape (N,)
            In seconds, in any order.

        Returns
        -------
        ndarray of shape (D N, D N)
            In the outputs' own units. Outputs are slowest, as in `ToyProcess`: entry
            (d N + i, e N + j) is the covariance of output d at time i with output e at time j.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the model has no such layer, or times are not finite numbers.
        """
        check_is_fitted(self)
        check_choice("layer", layer, self.layers)
        return self._process.prior_covariance(layer, check_times(times))

    @contextmanager
    def _threaded_process(self) -> Iterator[FittedProcess]:
        """Give the fitted process with its threads running."""
        with self._threaded(self._process) as process:
            yield process

    @contextmanager
    def _threaded(self, process: FittedProcess) -> Iterator[FittedProcess]:
        """Give a process with its threads running."""
        with thread_mapper(effective_n_jobs(self.n_jobs)) as mapper:
            yield process.with_mapper(mapper)
