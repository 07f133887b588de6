r"""What a model is, and what it may be able to do.

A model learns from recordings, hidden entries included, and then has abilities. Each ability is
an abstract base class, so that a model says what it can do by what it inherits:

* `FrameImputer` fills whole hidden frames: the mean, and if the model has one the variance, of
  :math:`p(y_{\text{hidden}} \mid y_{\text{visible}})` where every frame is visible or hidden
  as a whole;
* `Imputer` does so for any set of hidden entries, and is therefore a `FrameImputer`;
* `Inductive` marks an imputer that also fills recordings which `fit` has not seen;
* `Synthesiser` draws new recordings from :math:`p(y_{\text{new}} \mid y_{\text{visible}})`;
* `Clusterer` groups the recordings that it was fitted to;
* `Aligner` maps the frames of recordings of a cyclic motion onto the states of one cycle;
* `Blender` mixes the styles that it has found;
* `Trended` infers a trend that the recordings vary around;
* `Layered` shows the covariance of each of its layers, and `Coregionalised` the matrices in it;
* `Embedded` gives every frame a position in a latent space, and `Dynamical` walks through it;
* `Informed` is told the generating process (the oracle);
* `Misinformed` is told another process instead (the control).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.base import BaseEstimator

from mocapbench.datasets import FrameByChannel, Frames, Recording, ToyProcess

__all__ = [
    "Aligner",
    "Blender",
    "Clusterer",
    "Coregionalised",
    "Dynamical",
    "Embedded",
    "FrameByStyle",
    "FrameImputer",
    "Imputer",
    "Inductive",
    "Informed",
    "Layered",
    "Misinformed",
    "Model",
    "Prediction",
    "SampleByFrameByChannel",
    "StatePath",
    "Synthesiser",
    "Trended",
]

StatePath = NDArray[np.intp]
"""(N,) the state of the common cycle, 0 … M − 1, that each frame of a recording is in."""

FrameByStyle = NDArray[np.float64]
"""(N, C) one row a frame, one column a style."""

SampleByFrameByChannel = NDArray[np.float64]
"""(n, N, D) n sampled recordings."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """A predictive distribution of the observations of one recording.

    Parameters
    ----------
    mean : ndarray of shape (N, D)
        Visible entries are copied.
    variance : ndarray of shape (N, D) or None
        Variance of an observation, noise included, and 0 at visible entries. None says that the
        model has no predictive distribution.
    """

    mean: FrameByChannel
    variance: FrameByChannel | None = None

    @classmethod
    def around(
        cls, recording: Recording, mean: FrameByChannel, variance: FrameByChannel | None = None
    ) -> Prediction:
        """Return ``mean`` and ``variance`` at the hidden entries, the data at the visible ones."""
        visible = recording.visible
        return cls(
            np.where(visible, recording.values, mean),
            None if variance is None else np.where(visible, 0.0, variance),
        )


class Model(BaseEstimator, ABC):  # type: ignore[misc]
    """A scikit-learn style estimator of motion: ``__init__`` stores, `fit` learns."""

    @abstractmethod
    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn from recordings with the same channels, incomplete ones included."""


class FrameImputer(Model):
    """A model that fills frames which are hidden as a whole."""

    @abstractmethod
    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return one prediction per recording, in order.

        Unless the model is `Inductive`, each recording must have been seen in `fit` under the
        same name.
        """


class Imputer(FrameImputer):
    """A model that fills any set of hidden entries."""


class Inductive(Model):
    """Marks an imputer whose `impute` also takes recordings that `fit` has not seen."""


class Synthesiser(Model):
    """A model that draws new recordings."""

    @abstractmethod
    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return ``n_samples`` new recordings at ``times`` (N,), noise included: (n, N, D)."""


class Clusterer(Model):
    """A model that groups the recordings it is fitted to.

    Its constructor takes ``n_styles``, the number of clusters to find at most.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        After `fit`, the cluster of each recording, in the order given; equal means together.
    """

    labels_: NDArray[np.intp]


class Aligner(Model):
    """A model that puts recordings of a cyclic motion on one common cycle.

    Attributes
    ----------
    cycle_length_ : int
        After `fit`, the number of states M of the cycle.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        After `fit`, the state 0 … M − 1 of each frame of each recording, in the order given.
    """

    cycle_length_: int
    path_: tuple[StatePath, ...]

    @abstractmethod
    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the path of each recording (N_k,) over the states 0 … M − 1, in order."""


class Blender(Clusterer):
    """A clusterer whose styles can be mixed, because their cycles are synchronous."""

    @abstractmethod
    def blend(self, weights: FrameByStyle) -> FrameByChannel:
        """Return a motion whose frame i is the styles' mean poses mixed by row i of ``weights``.

        Parameters
        ----------
        weights : array_like of shape (N, n_styles)
            Non-negative, each row's sum 1; column c weighs the style that `labels_` calls c.

        Returns
        -------
        ndarray of shape (N, D)
            N frames at the pace and in the channels of the recordings given to `fit`.
        """


class Trended(Model):
    """A model of recordings that vary around one trend."""

    @abstractmethod
    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the trend's posterior mean and variance at ``times`` (N,): (N, D) each."""


class Layered(Model):
    """A model whose prior covariances can be looked at, one layer of its hierarchy at a time."""

    @property
    @abstractmethod
    def layers(self) -> tuple[str, ...]:
        """After `fit`, the layers' names, outermost first; the last is that of each recording."""

    @abstractmethod
    def covariance(self, layer: str, times: Frames) -> NDArray[np.float64]:
        """Return a layer's covariance at ``times`` (N,), (D N, D N), outputs slowest, no noise."""


class Coregionalised(Layered):
    """A layered model whose layers are linear models of coregionalisation.

    Attributes
    ----------
    coregionalisation_ : mapping of str to ndarray of shape (Q, D, D)
        After `fit`, the matrices B_q of each layer, in the outputs' own units.
    """

    @property
    @abstractmethod
    def coregionalisation_(self) -> Mapping[str, NDArray[np.float64]]:
        """The matrices B_q of each layer."""


class Embedded(Model):
    """A model whose frames have positions in a latent space.

    Attributes
    ----------
    kernel_properties_ : mapping of str to float
        After `fit`, what its parameters amount to, by name.
    """

    kernel_properties_: Mapping[str, float]

    @abstractmethod
    def latent_paths(self) -> list[NDArray[np.float64]]:
        """Return the positions (N_p, d) of each stretch of training frames."""

    @abstractmethod
    def confidence(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return −ln of the variance of poses at ``positions`` (n, d), on the model's scale."""


class Dynamical(Embedded):
    """A model that moves through its latent space."""

    @abstractmethod
    def latent_walks(
        self, n_frames: int, n_samples: int, random_state: int | np.random.Generator
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the mean trajectory (N, d) from where training starts, and samples (n, N, d)."""

    @abstractmethod
    def poses(self, positions: NDArray[np.float64]) -> FrameByChannel:
        """Return the mean poses (N, D) at ``positions`` (N, d)."""


class Informed(Model):
    """A model that is served only where the data have a known generating process."""

    @abstractmethod
    def inform(self, process: ToyProcess) -> Self:
        """Take the process that generated the recordings; called before `fit`."""


class Misinformed(Model):
    """A model that is served only where there is a process unrelated to the recordings."""

    @abstractmethod
    def misinform(self, process: ToyProcess) -> Self:
        """Take a process that generated none of the recordings; called before `fit`."""
